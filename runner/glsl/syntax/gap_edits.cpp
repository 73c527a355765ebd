#include "glsl/syntax/gap_edits.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// Returns the macro whose body contains a token; nullptr if none does.
const MacroLine* macro_around(const Preprocessed& preprocessed, size_t token) {
    const auto& macros = preprocessed.macros;
    auto next = std::ranges::upper_bound(macros, token, {}, &MacroLine::hash);
    if (next == macros.begin())
        return nullptr;
    const MacroLine& macro = *std::prev(next);
    return token >= macro.body && token < macro.end ? &macro : nullptr;
}

} // namespace

GapEdits::GapEdits(const ParsedText& text) : text_(text), words_(text) {
    std::vector<uint8_t> count(text.tokens().size(), 0);
    for (const Word& word : text.words())
        count[word.spelled] = uint8_t(std::min(count[word.spelled] + 1, 2));
    for (uint32_t i = 0; i < text.words().size(); ++i)
        if (count[text.words()[i].spelled] > 1)
            uses_.push_back({text.words()[i].spelled, i});
    std::ranges::stable_sort(uses_, {}, &Use::token);
    for (const MacroLine& macro : text.preprocessed().macros) {
        bool& takes_arguments = macros_.try_emplace(macro.name, true).first->second;
        takes_arguments = takes_arguments && (macro.parameters || macro.undefines);
    }
}

void GapEdits::offer(size_t gap, std::string_view insertion, bool needed) {
    Offer& offer = offers_[gap];
    offer.text += insertion;
    offer.needed = offer.needed || needed;
}

void GapEdits::offer_else(size_t gap, size_t other, std::string_view insertion) {
    Offer& offer = offers_[gap];
    offer.other = other;
    offer.else_text += insertion;
}

/// Checks that no macro and no macro parameter changes the meaning of `insertion` at that token.
bool GapEdits::means_itself(const std::string& insertion, size_t token) const {
    const std::vector<text::Token> words = text::tokenize(insertion);
    const MacroLine* const around = macro_around(text_.preprocessed(), token);
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i].kind != text::TokenKind::identifier)
            continue;
        const bool called = i + 1 < words.size() && words[i + 1].is("(");
        if (const auto macro = macros_.find(words[i].text); macro != macros_.end())
            if (called || !macro->second)
                return false;
        for (size_t p = around ? around->hash + 3 : 0; around && around->parameters && p < around->body; ++p)
            if (text_.tokens()[p].text == words[i].text)
                return false;
    }
    return true;
}

/// Checks that `insertion` can go next to the token of `word`, on the side of `gap`.
bool GapEdits::fits(size_t word, size_t gap, const std::string& insertion) const {
    const uint32_t token = text_.words()[word].spelled;
    const auto whole = [&](size_t index) {
        return text_.words()[index].text.data() == text_.tokens()[token].text.data() &&
               text_.words()[index].text.size() == text_.tokens()[token].text.size();
    };
    if (!whole(word) || !means_itself(insertion, token))
        return false;
    const auto before = [](const Use& use, uint32_t wanted) { return use.token < wanted; };
    const auto behind = [](uint32_t wanted, const Use& use) { return wanted < use.token; };
    const auto begin = std::lower_bound(uses_.begin(), uses_.end(), token, before);
    const auto end = std::upper_bound(begin, uses_.end(), token, behind);
    return std::all_of(begin, end, [&](const Use& use) {
        const auto offer = offers_.find(use.word + (gap - word));
        return whole(use.word) && offer != offers_.end() && offer->second.text == insertion;
    });
}

std::optional<size_t> GapEdits::place(size_t gap, const std::string& insertion) const {
    const std::vector<Word>& words = text_.words();
    if (gap == 0 || gap >= words.size())
        return std::nullopt;
    if (fits(gap - 1, gap, insertion))
        return text_.tokens()[words[gap - 1].spelled].end();
    if (words_.begins_alone(gap) && means_itself(insertion, words[gap].used))
        return words_.begin_of(gap);
    if (fits(gap, gap, insertion))
        return text_.tokens()[words[gap].spelled].begin;
    return std::nullopt;
}

std::vector<text::Edit> GapEdits::edits() const {
    std::map<size_t, std::string> chosen; // one place may serve several gaps, if their insertions are equal
    for (const auto& [gap, offer] : offers_)
        if (offer.needed) {
            if (const auto at = place(gap, offer.text)) {
                const auto [known, fresh] = chosen.emplace(*at, offer.text);
                if (!fresh && known->second != offer.text)
                    known->second += offer.text;
            } else if (offer.other != 0 && offer.other < text_.words().size() &&
                       words_.begins_alone(offer.other) &&
                       means_itself(offer.else_text, text_.words()[offer.other].used))
                chosen[words_.begin_of(offer.other)] += offer.else_text;
        }
    std::vector<text::Edit> edits;
    for (const auto& [at, text] : chosen)
        edits.push_back({at, at, text});
    return edits;
}

} // namespace tidemark::glsl
