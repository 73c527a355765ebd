#include "glsl/rewrite.hpp"

#include <fmt/format.h>

#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Edit;
using text::Token;

constexpr std::string_view k_plain_name = "tidemark_plain_";

class ArgumentSettler {
public:
    ArgumentSettler(const std::vector<Token>& tokens, const Preprocessed& preprocessed)
        : tokens_(tokens), preprocessed_(preprocessed) {
        for (const MacroLine& macro : preprocessed.macros)
            if (macro.parameters)
                macros_.insert(macro.name);
    }

    std::vector<Edit> run() {
        for (size_t i = 0; !macros_.empty() && i < tokens_.size();) {
            if (tokens_[i].first_on_line && tokens_[i].is("#")) {
                const size_t end = text::end_of_directive(tokens_, i);
                if (depth_ > 0)
                    directive(i, end);
                i = end;
            } else {
                token(i++);
            }
        }
        return std::move(edits_);
    }

private:
    void directive(size_t hash, size_t end) {
        const std::string_view keyword = hash + 1 < end ? tokens_[hash + 1].text : std::string_view{};
        if (keyword.starts_with("if"))
            ++groups_;
        else if (keyword == "endif")
            --groups_;
        else if (keyword != "else" && keyword != "elif")
            give_up();
        call_.push_back({tokens_[hash].begin, tokens_[end - 1].end(), {}});
    }

    void token(size_t i) {
        const Token& token = tokens_[i];
        if (preprocessed_.activity[i] == Activity::inactive) {
            if (depth_ > 0)
                call_.push_back({token.begin, token.end(), {}});
        } else if (depth_ == 0) {
            if (token.is("(") && i > 0 && macros_.contains(tokens_[i - 1].text))
                begin_call();
        } else if (preprocessed_.activity[i] == Activity::unknown && groups_ > 0) {
            give_up();
        } else if (token.is("(")) {
            ++depth_;
        } else if (token.is(")") && --depth_ == 0 && groups_ == 0) {
            edits_.insert(edits_.end(), call_.begin(), call_.end());
        }
    }

    void begin_call() {
        depth_ = 1;
        groups_ = 0;
        call_.clear();
    }

    void give_up() { depth_ = 0; }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    std::unordered_set<std::string_view> macros_; ///< macros with arguments
    int depth_ = 0;                               ///< of parentheses in the outermost call
    int groups_ = 0;                              ///< open #if in that call
    std::vector<Edit> call_;
    std::vector<Edit> edits_;
};

/// Returns the uses of macros with arguments before a `)`, up to the last directive.
std::vector<size_t> plain_uses(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    std::unordered_set<std::string_view> macros;
    for (const MacroLine& macro : preprocessed.macros)
        if (macro.parameters)
            macros.insert(macro.name);
    const auto& code = preprocessed.code;
    std::vector<size_t> uses, settled;
    for (size_t i = 0; !macros.empty() && i + 1 < code.size(); ++i) {
        if (macros.contains(tokens[code[i]].text) && tokens[code[i + 1]].is(")"))
            uses.push_back(code[i]);
        if (code[i + 1] == code[i] + 1 || uses.empty())
            continue;
        settled.insert(settled.end(), uses.begin(), uses.end()); // a directive separates these tokens
        uses.clear();
    }
    return settled;
}

} // namespace

PlainNames name_plainly(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    PlainNames names;
    std::unordered_set<std::string_view> known;
    for (const size_t use : plain_uses(tokens, preprocessed)) {
        const Token& token = tokens[use];
        names.edits.push_back({token.begin, token.end(), fmt::format("{}{}", k_plain_name, token.text)});
        if (known.insert(token.text).second)
            names.macros += fmt::format("#define {}{} {}\n", k_plain_name, token.text, token.text);
    }
    return names;
}

std::vector<Edit> settle_arguments(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return ArgumentSettler(tokens, preprocessed).run();
}

} // namespace tidemark::glsl
