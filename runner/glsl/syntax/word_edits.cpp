#include "glsl/syntax/word_edits.hpp"

#include "glsl/syntax/words.hpp"

#include <algorithm>

namespace tidemark::glsl {

WordEdits::WordEdits(const ParsedText& text)
    : text_(text), last_before_(text.words().size() + 1),
      first_from_(text.words().size() + 1, uint32_t(text.tokens().size())),
      gone_(text.tokens().size(), false) {
    const std::vector<Word>& words = text.words();
    for (size_t i = 0; i < words.size(); ++i)
        last_before_[i + 1] = std::max(last_before_[i], words[i].used);
    for (size_t i = words.size(); i-- > 0;)
        first_from_[i] = std::min(first_from_[i + 1], words[i].used);
}

/// The tokens up to the next word may include the `)` of a macro call that begins before these words.
bool WordEdits::stands_alone(size_t begin, size_t end) const {
    if (begin >= end || !begins_alone(begin) || last_before_[end] >= first_from_[end])
        return false;
    const std::vector<size_t>& code = text_.preprocessed().code;
    int depth = 0;
    for (auto at = std::lower_bound(code.begin(), code.end(), size_t(first_from_[begin]));
         at != code.end() && *at < first_from_[end]; ++at) {
        const text::Token& token = text_.tokens()[*at];
        depth += nesting(token.text);
        if (depth < 0)
            return false;
    }
    return depth == 0;
}

std::pair<size_t, size_t> WordEdits::tokens_of(size_t begin, size_t end) const {
    const std::vector<size_t>& code = text_.preprocessed().code;
    return {first_from_[begin], *std::prev(std::ranges::lower_bound(code, size_t(first_from_[end])))};
}

void WordEdits::replace(size_t begin, size_t end, std::string_view replacement) {
    const std::vector<text::Token>& tokens = text_.tokens();
    const std::vector<size_t>& code = text_.preprocessed().code;
    const size_t last = first_from_[end];
    std::string text = " " + std::string(replacement) + " "; // keeps the neighbours apart
    auto at = std::lower_bound(code.begin(), code.end(), size_t(first_from_[begin]));
    while (at != code.end() && *at < last) {
        const size_t first = *at;
        size_t token = first;
        gone_[token] = true;
        while (++at != code.end() && *at < last && *at == token + 1)
            gone_[token = *at] = true;
        edits_.push_back({tokens[first].begin, tokens[token].end(), std::move(text)});
        text = " ";
    }
}

void WordEdits::insert(size_t word, std::string_view insertion) {
    edits_.push_back({begin_of(word), begin_of(word), std::string(insertion)});
}

/// Drops edits inside a larger removal, for example a removed branch of a removed function.
text::MappedText WordEdits::apply() const {
    std::vector<text::Edit> edits = edits_;
    std::stable_sort(edits.begin(), edits.end(), [](const text::Edit& a, const text::Edit& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    size_t covered = 0;
    std::erase_if(edits, [&covered](const text::Edit& edit) {
        const bool inside = edit.begin < covered;
        covered = std::max(covered, edit.end);
        return inside;
    });
    text::MappedText result = text_.source();
    result.apply(edits);
    return result;
}

int WordEdits::emptied_lines() const {
    const std::vector<text::Token>& tokens = text_.tokens();
    const std::vector<size_t>& code = text_.preprocessed().code;
    int count = 0;
    for (size_t i = 0; i < code.size();) {
        const int line = tokens[code[i]].line;
        bool all_gone = true;
        for (; i < code.size() && tokens[code[i]].line == line; ++i)
            all_gone = all_gone && gone_[code[i]];
        count += all_gone && !text_.source().lines().locate(line).file.empty();
    }
    return count;
}

} // namespace tidemark::glsl
