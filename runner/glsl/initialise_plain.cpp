#include "glsl/initialise.hpp"
#include "glsl/syntax/functions.hpp"
#include "glsl/syntax/types.hpp"
#include "glsl/syntax/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
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
