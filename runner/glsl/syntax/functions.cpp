#include "glsl/syntax/functions.hpp"

#include "glsl/syntax/words.hpp"

#include <algorithm>
#include <optional>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

class FunctionReader {
public:
    FunctionReader(const std::vector<Token>& tokens, const std::vector<size_t>& code)
        : tokens_(tokens), code_(code) {}

    std::vector<Function> run() {
        while (at_ < code_.size()) {
            if (here().is("{")) {
                at_ = past_braces(at_);
            } else if (auto function = read()) {
                at_ = past(*function);
                functions_.push_back(*std::move(function));
            } else {
                ++at_;
            }
        }
        return std::move(functions_);
    }

private:
    const Token& token(size_t i) const {
        static const Token k_none;
        return i < code_.size() ? tokens_[code_[i]] : k_none;
    }
    const Token& here() const { return token(at_); }
    bool is_name(size_t i) const {
        return token(i).kind == TokenKind::identifier && !is_keyword(token(i).text);
    }

    /// Reads `TYPE NAME (…)` followed by `{` or `;`.
    std::optional<Function> read() {
        const bool type = is_name(at_) || here().is("void");
        if (!type || !is_name(at_ + 1) || !token(at_ + 2).is("("))
            return std::nullopt;
        Function function;
        function.return_type = here().text;
        function.name = token(at_ + 1).text;
        function.type_token = code_[at_];
        function.name_token = code_[at_ + 1];
        function.open = code_[at_ + 2];
        size_t i = at_ + 3;
        for (; i < code_.size() && !token(i).is(")"); ++i)
            if (token(i).is("(") || token(i).is("{") || token(i).is(";"))
                return std::nullopt;
        if (i >= code_.size() || !(token(i + 1).is("{") || token(i + 1).is(";")))
            return std::nullopt;
        function.close = code_[i];
        end_ = i + 1;
        for (size_t first = at_ + 3; first < i;)
            first = read_parameter(function, first, i);
        return function;
    }

    /// Reads a parameter from its first token on; returns where the next one begins.
    size_t read_parameter(Function& function, size_t first, size_t close) const {
        Parameter parameter;
        size_t i = first;
        for (; i < close && !token(i).is(","); ++i) {
            const Token& word = token(i);
            if (word.is("out") || word.is("inout")) {
                parameter.written = true;
                parameter.read = word.is("inout");
            } else if (word.is("[")) {
                parameter.array = true;
            } else if (is_name(i) && parameter.type.empty()) {
                parameter.type = word.text;
            } else if (is_name(i) && parameter.name.empty() && !parameter_array_size(i)) {
                parameter.name = word.text;
            }
        }
        if (!parameter.type.empty())
            function.parameters.push_back(parameter);
        return i + 1;
    }

    bool parameter_array_size(size_t i) const { return token(i - 1).is("["); }

    size_t past(Function& function) const {
        if (!token(end_).is("{"))
            return end_;
        const size_t behind = past_braces(end_);
        function.body_begin = code_[end_];
        function.body_end = code_[behind - 1];
        return behind;
    }

    size_t past_braces(size_t i) const {
        int depth = 0;
        for (; i < code_.size(); ++i) {
            depth += token(i).is("{") ? 1 : token(i).is("}") ? -1 : 0;
            if (depth == 0)
                return i + 1;
        }
        return i;
    }

    const std::vector<Token>& tokens_;
    const std::vector<size_t>& code_;
    std::vector<Function> functions_;
    size_t at_ = 0;
    size_t end_ = 0; ///< end of the last head: its `{` or `;`
};

} // namespace

bool Function::writes_argument() const {
    return std::any_of(parameters.begin(), parameters.end(), [](const auto& each) { return each.written; });
}

std::vector<Function> find_functions(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return FunctionReader(tokens, preprocessed.code).run();
}

const Function* function_around(const std::vector<Function>& functions, size_t token) {
    auto next =
        std::upper_bound(functions.begin(), functions.end(), token,
                         [](size_t wanted, const Function& each) { return wanted < each.type_token; });
    if (next == functions.begin())
        return nullptr;
    --next;
    return next->defined() && token <= next->body_end ? &*next : nullptr;
}

} // namespace tidemark::glsl
