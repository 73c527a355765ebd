// Edits of a text by token: several passes may add text before and after a token, or replace it.
#pragma once

#include "text/mapped_text.hpp"
#include "text/tokens.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

class TokenEdits {
public:
    void before(size_t token, std::string_view text) { changes_[token].before += text; }
    void after(size_t token, std::string_view text) { changes_[token].after += text; }
    void replace(size_t token, std::string_view text) { changes_[token].replacement = text; }
    void remove(size_t token) { replace(token, {}); }

    /// Returns edits for MappedText: sorted, without overlap.
    std::vector<text::Edit> edits(const std::vector<text::Token>& tokens) const {
        std::vector<text::Edit> edits;
        for (const auto& [index, change] : changes_) {
            const text::Token& token = tokens[index];
            edits.push_back(
                {token.begin, token.end(),
                 change.before + change.replacement.value_or(std::string(token.text)) + change.after});
        }
        return edits;
    }

private:
    struct Change {
        std::string before;
        std::string after;
        std::optional<std::string> replacement;
    };
    std::map<size_t, Change> changes_;
};

} // namespace tidemark::glsl
