// Mesa's preprocessor hands its result on as text: where `-` meets a macro that begins with `-`, the compiler
// reads `--`. A blank between them keeps them apart, as they are on the site.
#include "glsl/rewrite.hpp"

#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Edit;
using text::Token;
using text::TokenKind;

bool is_sign(const Token& token) {
    return token.is("+") || token.is("-");
}

class Spacer {
public:
    Spacer(const std::vector<Token>& tokens, const Preprocessed& preprocessed)
        : tokens_(tokens), preprocessed_(preprocessed) {}

    std::vector<Edit> run() {
        for (const MacroLine& macro : preprocessed_.macros)
            if (!macro.undefines && macro.body < macro.end)
                note(macro);
        if (functions_.empty() && trailing_.empty())
            return {};
        read_uses();
        for (const MacroLine& macro : preprocessed_.macros)
            if (signed_calls_.contains(macro.name))
                space_parameters(macro);
        return std::move(edits_);
    }

private:
    void note(const MacroLine& macro) {
        if (macro.parameters)
            functions_[macro.name] =
                is_sign(tokens_[macro.body]) ? tokens_[macro.body].text : std::string_view{};
        else if (is_sign(tokens_[macro.end - 1]) && macro.end > macro.body + 1)
            trailing_[macro.name] = tokens_[macro.end - 1].text;
    }

    /// One pass over all calls: which meet a sign, and which are given one.
    void read_uses() {
        std::vector<std::string_view> calls; // for each open parenthesis, the macro it belongs to
        for (size_t i = 1; i < tokens_.size(); ++i) {
            const Token& token = tokens_[i];
            const Token& before = tokens_[i - 1];
            if (token.is("(")) {
                calls.push_back(functions_.contains(before.text) ? before.text : std::string_view{});
            } else if (token.is(")")) {
                if (!calls.empty())
                    calls.pop_back();
            } else if (is_sign(token)) {
                if (!calls.empty() && !calls.back().empty() && (before.is("(") || before.is(",")))
                    signed_calls_.insert(calls.back());
                const auto ending = trailing_.find(before.text);
                if (ending != trailing_.end() && ending->second == token.text && token.glued)
                    edits_.push_back({token.begin, token.begin, " "});
            } else if (token.kind == TokenKind::identifier && token.glued && is_sign(before)) {
                const auto called = functions_.find(token.text);
                if (called != functions_.end() && called->second == before.text)
                    edits_.push_back({token.begin, token.begin, " "});
            }
        }
    }

    void space_parameters(const MacroLine& macro) {
        std::unordered_set<std::string_view> parameters;
        for (size_t i = macro.hash + 3; i < macro.body; ++i)
            parameters.insert(tokens_[i].text);
        for (size_t i = macro.body + 1; i < macro.end; ++i)
            if (tokens_[i].glued && is_sign(tokens_[i - 1]) && parameters.contains(tokens_[i].text))
                edits_.push_back({tokens_[i].begin, tokens_[i].begin, " "});
    }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    std::unordered_map<std::string_view, std::string_view> functions_; ///< with the sign they begin with
    std::unordered_map<std::string_view, std::string_view> trailing_;  ///< with the sign they end in
    std::unordered_set<std::string_view> signed_calls_; ///< called with an argument that begins with a sign
    std::vector<Edit> edits_;
};

} // namespace

std::vector<Edit> separate_signs(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return Spacer(tokens, preprocessed).run();
}

} // namespace tidemark::glsl
