// Insertions between words of the expanded code, made in the source text: in the code, or in a macro's body
// if every use of that place needs the same insertion.
#pragma once

#include "glsl/syntax/word_edits.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
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

} // namespace tidemark::glsl
