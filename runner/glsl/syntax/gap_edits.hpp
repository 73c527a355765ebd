// Insertions between words, carried out in the text before its macros: in the code or in what a macro stands
// for, wherever every use of that place wants the same.
#pragma once

#include "glsl/syntax/word_edits.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// Refers to the text, which must outlive it. A gap has the number of the word behind it.
class GapEdits {
public:
    explicit GapEdits(const ParsedText& text);

    /// `insertion` may be made in `gap`: where it is not needed it does no harm, and is made where other uses
    /// of the same place need it.
    void offer(size_t gap, std::string_view insertion, bool needed);
    /// What is needed in `gap`, and finds no place, is done by `insertion` in another gap.
    void offer_else(size_t gap, size_t other, std::string_view insertion);

    /// Sorted. What finds no place is left out.
    std::vector<text::Edit> edits() const;

private:
    struct Offer {
        std::string text{};
        bool needed = false;
        size_t other = 0; ///< gap; 0: there is none
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
    std::vector<Use> uses_; ///< of tokens that more than one word comes from, sorted
    std::unordered_map<std::string_view, bool> macros_; ///< whether they always take arguments
    std::map<size_t, Offer> offers_;
};

} // namespace tidemark::glsl
