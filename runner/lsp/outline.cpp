#include "lsp/outline.hpp"

#include "glsl/syntax/reading.hpp"
#include "lsp/comments.hpp"

#include <algorithm>

namespace tidemark::lsp {
namespace {

using glsl::Reading;
using text::Token;
using text::TokenKind;
using Kind = Symbol::Kind;

constexpr std::string_view k_knob = "iUniform";

/// Joins tokens, with one blank for each run of blanks, line ends and comments.
std::string on_one_line(const std::vector<Token>& tokens, size_t begin, size_t end) {
    std::string line;
    for (size_t i = begin; i < end; ++i) {
        if (i > begin && !tokens[i].glued)
            line += ' ';
        line += tokens[i].text;
    }
    return line;
}

class Outliner {
public:
    explicit Outliner(std::string_view text) : text_(text), reading_(text) {}

    std::vector<Symbol> run() {
        for (const glsl::Function& function : reading_.functions)
            if (function.defined())
                add_function(function);
        for (const glsl::MacroLine& macro : reading_.preprocessed.macros)
            if (!macro.undefines)
                add(Kind::macro, macro.hash, macro.hash + 2, macro.end, macro.end);
        for (const size_t hash : reading_.preprocessed.directives)
            add_knob(hash);
        add_globals();
        std::ranges::sort(symbols_, {}, &Symbol::begin);
        return std::move(symbols_);
    }

private:
    const std::vector<Token>& tokens() const { return reading_.tokens; }

    /// Adds a symbol for the tokens [first, last); those before `shown` are its signature.
    void add(Kind kind, size_t first, size_t name, size_t shown, size_t last) {
        if (name >= tokens().size() || last <= first || last > tokens().size())
            return;
        symbols_.push_back({kind, std::string(tokens()[name].text), on_one_line(tokens(), first, shown),
                            comment_above(text_, tokens()[first].begin), tokens()[first].begin,
                            tokens()[last - 1].end(), tokens()[name].begin});
    }

    void add_function(const glsl::Function& function) {
        add(Kind::function, function.type_token, function.name_token, function.close + 1,
            function.body_end + 1);
    }

    /// Adds a knob's line: `#iUniform float speed = 1.0 in { 0.0, 2.0 }`.
    void add_knob(size_t hash) {
        const size_t end = text::end_of_directive(tokens(), hash);
        if (hash + 3 < end && tokens()[hash + 1].is(k_knob))
            add(Kind::knob, hash, hash + 3, end, end);
    }

    /// Adds the declarations between semicolons outside of braces and functions.
    void add_globals() {
        size_t first = 0;
        bool begun = false;
        const std::vector<size_t>& code = reading_.preprocessed.code;
        for (size_t at = 0; at < code.size(); ++at) {
            const size_t i = code[at];
            if (!begun) {
                first = i;
                begun = true;
            }
            if (const glsl::Function* function = glsl::function_around(reading_.functions, i)) {
                while (at + 1 < code.size() && code[at + 1] <= function->body_end)
                    ++at;
                begun = false;
            } else if (tokens()[i].is("{") || tokens()[i].is("(")) {
                const size_t close = reading_.closing(i, tokens().size());
                while (at + 1 < code.size() && code[at + 1] <= close)
                    ++at;
            } else if (tokens()[i].is(";")) {
                add_declaration(first, i);
                begun = false;
            }
        }
    }

    /// Adds the names declared by the tokens [first, end): `const float a = 1.0, b[2];`, `struct Ray { … }
    /// ray;`.
    void add_declaration(size_t first, size_t end) {
        size_t at = first;
        bool constant = false;
        while (at < end && is_qualifier(tokens()[at].text))
            constant |= tokens()[at++].is("const");
        if (at + 1 >= end || tokens()[at].kind != TokenKind::identifier)
            return;
        if (tokens()[at].is("struct")) {
            add(Kind::structure, first, at + 1, at + 2, end);
            return;
        }
        // The names follow the type, separated by commas outside of brackets.
        bool expects_name = true;
        for (size_t i = at + 1; i < end; ++i) {
            if (tokens()[i].is("(") || tokens()[i].is("[") || tokens()[i].is("{")) {
                if (expects_name && tokens()[i].is("("))
                    return; // a function prototype
                i = reading_.closing(i, end);
            } else if (tokens()[i].is(",")) {
                expects_name = true;
            } else if (expects_name && tokens()[i].kind == TokenKind::identifier) {
                if (i + 1 < end && tokens()[i + 1].is("("))
                    return;
                add(constant ? Kind::constant : Kind::variable, first, i, end, end);
                expects_name = false;
            }
        }
    }

    static bool is_qualifier(std::string_view word) {
        constexpr std::string_view k_words[] = {"const", "uniform", "in",   "out",     "flat",
                                                "highp", "mediump", "lowp", "precise", "invariant"};
        return std::ranges::find(k_words, word) != std::end(k_words);
    }

    std::string_view text_;
    Reading reading_;
    std::vector<Symbol> symbols_;
};

} // namespace

std::vector<Symbol> outline(std::string_view text) {
    return Outliner(text).run();
}

} // namespace tidemark::lsp
