#include "glsl/rewrite.hpp"

#include <unordered_map>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Edit;
using text::Token;

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
        for (size_t i = 1; i < tokens_.size(); ++i)
            if (tokens_[i].glued && may_meet(i))
                edits_.push_back({tokens_[i].begin, tokens_[i].begin, " "});
        for (const MacroLine& macro : preprocessed_.macros)
            if (macro.parameters)
                space_parameters(macro);
        return std::move(edits_);
    }

private:
    void note(const MacroLine& macro) {
        if (macro.parameters)
            functions_.insert(macro.name);
        else if (is_sign(tokens_[macro.end - 1]) && macro.end > macro.body + 1)
            trailing_[macro.name] = tokens_[macro.end - 1].text;
    }

    /// The replacement of a macro with parameters may begin with a sign, its own or an argument's.
    bool may_meet(size_t i) const {
        const Token& before = tokens_[i - 1];
        if (is_sign(before))
            return functions_.contains(tokens_[i].text);
        const auto ending = is_sign(tokens_[i]) ? trailing_.find(before.text) : trailing_.end();
        return ending != trailing_.end() && ending->second == tokens_[i].text;
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
    std::unordered_set<std::string_view> functions_;                  ///< macros with parameters
    std::unordered_map<std::string_view, std::string_view> trailing_; ///< macros that end in a sign
    std::vector<Edit> edits_;
};

} // namespace

std::vector<Edit> separate_signs(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return Spacer(tokens, preprocessed).run();
}

} // namespace tidemark::glsl
