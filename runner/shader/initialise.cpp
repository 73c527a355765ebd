// Insertions between words of the expanded code, made in the source text: in the code, or in a macro's body
// if every use of that place needs the same insertion.

#include "shader/parsed_text.hpp"
#include "shader/portability.hpp"
#include "shader/token_reading.hpp"
#include "shader/variables.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

/// Keeps a reference to the text, which must outlive it. A gap has the number of the word after it.
class GapEdits {
public:
    explicit GapEdits(const ParsedText& text);

    /// Offers `insertion` for `gap`. An insertion that is not `needed` is harmless; it is made only if
    /// another use of the same source place needs it.
    void offer(size_t gap, std::string_view insertion, bool needed);
    /// Adds a fallback: if the insertion needed in `gap` has no place in the source, `insertion` goes into
    /// gap `other`.
    void offer_else(size_t gap, size_t other, std::string_view insertion);

    /// Returns the edits, sorted. Insertions without a place are left out.
    std::vector<text::Edit> edits() const;

private:
    struct Offer {
        std::string text{};
        bool needed = false;
        size_t other = 0; ///< fallback gap; 0 if there is none
        std::string else_text{};
    };
    struct Use {
        uint32_t token;
        uint32_t word;
    };

    std::optional<size_t> place(size_t gap, const std::string& insertion) const;
    bool fits(size_t word, size_t gap, const std::string& insertion) const;
    bool means_itself(const std::string& insertion, size_t token) const;

    const ParsedText& text_;
    WordEdits words_;
    std::vector<Use> uses_; ///< words of source tokens that produce more than one word, sorted by token
    /// true if every definition of the macro takes arguments
    std::unordered_map<std::string_view, bool> macros_;
    std::map<size_t, Offer> offers_;
};

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

namespace {

/// Function, called when `main` begins, that sets the globals that are too large for an initialiser.
constexpr std::string_view k_start = "tidemark_start";
constexpr std::string_view k_value = "tidemark_value";
constexpr std::string_view k_unnamed = "tidemark_unnamed";

class Zeros {
public:
    explicit Zeros(const ParsedText& text)
        : text_(text), tree_(text.tree()), facts_(find_facts(text)), shapes_(text), gaps_(text) {}

    struct Changes {
        std::vector<text::Edit> edits;
        std::string functions; ///< text to append
    };

    Changes run() {
        const Assignment all = find_assignment(text_, facts_, shapes_);
        for (const UnsetVariable& variable : all.variables)
            if (variable.parameter)
                parameter(variable);
            else if (variable.global)
                global(variable);
            else
                local(variable);
        for (const NodeId function : all.without_return)
            add_return(function);
        for (NodeId id = tree_[0].first_child; id != k_no_node; id = tree_[id].next)
            if (tree_[id].kind == NodeKind::function)
                name_parameters(id);
        if (!start_.empty())
            start_in_main();
        Changes changes{gaps_.edits(), {}};
        if (!start_.empty()) // the author's last line may end in a backslash
            changes.functions = fmt::format("\nvoid {}() {{ {}}}\n", k_start, start_);
        return changes;
    }

private:
    void local(const UnsetVariable& variable) {
        const Node& declaration = tree_[tree_[variable.declared].parent];
        const bool statement = tree_[declaration.parent].kind == NodeKind::block;
        const std::string set = statement ? statements(name_of(variable), *variable.shape) : std::string();
        if (const auto value = zero(*variable.shape)) {
            const size_t behind = tree_[variable.declared].end;
            gaps_.offer(behind, "=" + *value, variable.needs_value());
            if (statement)
                gaps_.offer_else(behind, declaration.end, set);
        } else if (statement) {
            gaps_.offer(declaration.end, set, variable.needs_value());
        }
    }

    void global(const UnsetVariable& variable) {
        if (const auto value = zero(*variable.shape))
            gaps_.offer(tree_[variable.declared].end, "=" + *value, variable.needs_value());
        else if (variable.needs_value())
            start_ += statements(name_of(variable), *variable.shape);
    }

    void parameter(const UnsetVariable& variable) {
        const NodeId function = tree_[variable.declared].parent;
        for (NodeId body = tree_[variable.declared].next; body != k_no_node; body = tree_[body].next)
            if (tree_[body].kind == NodeKind::block && tree_[body].parent == function)
                gaps_.offer(tree_[body].begin + 1, statements(name_of(variable), *variable.shape),
                            variable.needs_value());
    }

    void add_return(NodeId function) {
        const Shape& shape = shapes_.of(tree_.child(function, 0), k_no_node);
        if (!shape.can_be_zero() || shape.type.empty())
            return;
        const auto value = zero(shape);
        const std::string text = value ? fmt::format("return {};", *value)
                                       : fmt::format("{} {};{}return {};", constructor_of(shape), k_value,
                                                     statements(std::string(k_value), shape), k_value);
        gaps_.offer(tree_[function].end - 1, text, true);
    }

    /// Mesa accepts a definition such as `float f(vec2) {…}` in GLSL ES only.
    void name_parameters(NodeId function) {
        const std::vector<NodeId> parts = tree_.children(function);
        if (tree_[parts.back()].kind != NodeKind::block)
            return;
        for (size_t i = 0; i < parts.size(); ++i) {
            const NodeId type = tree_[parts[i]].first_child;
            if (tree_[parts[i]].kind == NodeKind::parameter && tree_[parts[i]].word < tree_[type].end)
                gaps_.offer(tree_[type].end, fmt::format(" {}_{}", k_unnamed, i), true);
        }
    }

    void start_in_main() {
        for (NodeId id = tree_[0].first_child; id != k_no_node; id = tree_[id].next) {
            if (tree_[id].kind != NodeKind::function || text_.word_of(id) != "main")
                continue;
            gaps_.offer(tree_[id].begin, fmt::format("void {}();", k_start), true);
            for (const NodeId part : tree_.children(id))
                if (tree_[part].kind == NodeKind::block)
                    gaps_.offer(tree_[part].begin + 1, fmt::format("{}();", k_start), true);
        }
    }

    std::string name_of(const UnsetVariable& variable) const {
        return std::string(text_.word_of(variable.declared));
    }

    std::optional<std::string> zero(const Shape& shape) const { return zero_value(shape, facts_); }

    std::string statements(const std::string& place, const Shape& shape, int depth = 0) const {
        if (const auto value = zero(shape))
            return fmt::format("{}={};", place, *value);
        std::string text;
        if (shape.kind == Shape::Kind::structure) {
            for (const Shape::Member& member : shape.members)
                text += statements(fmt::format("{}.{}", place, member.name), *member.shape, depth);
            return text;
        }
        const std::string length =
            shape.length > 0 ? std::to_string(shape.length) : fmt::format("{}.length()", place);
        return fmt::format("for(int tidemark_{0}=0;tidemark_{0}<{1};++tidemark_{0}){{{2}}}", depth, length,
                           statements(fmt::format("{}[tidemark_{}]", place, depth), *shape.part, depth + 1));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts facts_;
    Shapes shapes_;
    GapEdits gaps_;
    std::string start_;
};

} // namespace

void start_at_zero(text::MappedText& text, Version version) {
    const bool es = version == Version::es_300;
    const std::array<KnownMacro, 3> known{{{"__VERSION__", es                             ? 300
                                                           : version == Version::core_450 ? 450
                                                                                          : 330},
                                           {"GL_FRAGMENT_PRECISION_HIGH", 1},
                                           {es ? "GL_ES" : "GL_core_profile", 1}}};
    const auto parsed = ParsedText::read(text, known, false);
    if (!parsed) {
        const std::vector<text::Token> tokens = text::tokenize(text.text());
        text.apply(initialise_plain(tokens, preprocess(tokens)));
        return;
    }
    const Zeros::Changes changes = Zeros(**parsed).run();
    text.apply(changes.edits);
    text.append_generated(changes.functions);
}

namespace {

using text::Token;
using text::TokenKind;

/// The built-in type names, and macros that stand for exactly one of them (common in code golf: `#define V
/// vec3`).
class TypeNames {
public:
    TypeNames(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
        for (const MacroLine& macro : preprocessed.macros) {
            if (macro.undefines)
                continue;
            bool& alias = macros_.try_emplace(macro.name, true).first->second;
            alias = alias && !macro.parameters && macro.end == macro.body + 1 &&
                    value_type(tokens[macro.body].text);
        }
    }

    bool contains(std::string_view word) const {
        const auto macro = macros_.find(word);
        return macro == macros_.end() ? value_type(word).has_value() : macro->second;
    }

private:
    std::unordered_map<std::string_view, bool> macros_; ///< whether each is such a type
};

/// Reads one run of tokens: the code of the text, or the body of one macro.
class Initialiser {
public:
    Initialiser(const std::vector<Token>& tokens, const TypeNames& types, std::vector<text::Edit>& edits)
        : tokens_(tokens), types_(types), edits_(edits) {}

    void run(std::span<const size_t> run, const std::unordered_set<std::string_view>& parameters) {
        run_ = run;
        parameters_ = &parameters;
        members_.clear();
        for (at_ = 0; at_ < run_.size(); ++at_)
            step();
    }

private:
    const Token& peek(long offset) const {
        static const Token k_none;
        const long i = long(at_) + offset;
        return i < 0 || size_t(i) >= run_.size() ? k_none : tokens_[run_[size_t(i)]];
    }

    void step() {
        const Token& token = peek(0);
        if (token.is("{"))
            members_.push_back(opens_members());
        else if (token.is("}") && !members_.empty())
            members_.pop_back();
        else if (token.kind == TokenKind::identifier && (members_.empty() || !members_.back()) &&
                 peek(1).kind == TokenKind::identifier && types_.contains(token.text) && begins_statement())
            read_declaration();
    }

    /// Checks for `struct S {`, `uniform Block {`.
    bool opens_members() const {
        for (const long i : {-1L, -2L})
            if (peek(i).is("struct") || peek(i).is("uniform") || peek(i).is("buffer"))
                return true;
        return false;
    }

    bool begins_statement() const {
        long i = -1;
        while (is_precision(peek(i).text))
            --i;
        const Token& before = peek(i);
        if (before.is("("))
            return peek(i - 1).is("for");
        return before.text.empty() || before.is(";") || before.is("{") || before.is("}") || before.is(")") ||
               before.is(":") || before.is("else") || before.is("do");
    }

    /// Reads `T a, b[2], c = …;` from its type on; discards its edits unless the declaration is complete.
    void read_declaration() {
        const std::string_view type = peek(0).text;
        const size_t known = edits_.size();
        do {
            ++at_;
            const Token& name = peek(0);
            if (name.kind != TokenKind::identifier || parameters_->contains(name.text))
                return give_up(known);
            ++at_;
            if (peek(0).is("[") || peek(0).is("="))
                skip_to_end_of_declarator();
            else
                edits_.push_back({name.end(), name.end(), fmt::format("={}(0)", type)});
        } while (peek(0).is(","));
        if (!peek(0).is(";"))
            give_up(known);
    }

    /// The token that stopped the parse may begin a declaration.
    void give_up(size_t known) {
        edits_.resize(known);
        --at_;
    }

    void skip_to_end_of_declarator() {
        int depth = 0;
        for (; at_ < run_.size(); ++at_) {
            const Token& token = peek(0);
            depth += nesting(token.text);
            if (depth < 0 || (depth == 0 && (token.is(",") || token.is(";"))))
                return;
        }
    }

    const std::vector<Token>& tokens_;
    const TypeNames& types_;
    std::vector<text::Edit>& edits_;
    std::span<const size_t> run_;
    const std::unordered_set<std::string_view>* parameters_ = nullptr;
    size_t at_ = 0;
    std::vector<bool> members_; ///< for each open brace, whether it contains members
};

} // namespace

std::vector<text::Edit> initialise_plain(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    std::vector<text::Edit> edits;
    const TypeNames types(tokens, preprocessed);
    Initialiser initialiser(tokens, types, edits);
    initialiser.run(preprocessed.code, {});
    for (const MacroLine& macro : preprocessed.macros) {
        std::vector<size_t> body;
        std::unordered_set<std::string_view> parameters;
        for (size_t i = macro.hash + 3; i < macro.body; ++i)
            parameters.insert(tokens[i].text);
        for (size_t i = macro.body; i < macro.end; ++i)
            body.push_back(i);
        initialiser.run(body, parameters);
    }
    for (const Function& function : find_functions(tokens, preprocessed))
        for (const Parameter& parameter : function.parameters)
            if (function.defined() && parameter.written && !parameter.read && !parameter.array &&
                !parameter.name.empty() && types.contains(parameter.type)) {
                const size_t at = tokens[function.body_begin].end();
                edits.push_back({at, at, fmt::format("{}={}(0);", parameter.name, parameter.type)});
            }
    std::ranges::stable_sort(edits, {}, &text::Edit::begin);
    return edits;
}

} // namespace tidemark::glsl
