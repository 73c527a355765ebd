// A cure of a fault in a text, as a plain value: what is to be written in front of and behind words of its
// author's, who loses none of them; and how that is put into a text.
#pragma once

#include "base/error.hpp"
#include "text/mapped_text.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A word where its author wrote it.
struct WrittenWord {
    SourceLocation where;
    std::string word;
};

/// `front` before the first word, `behind` after the last. Both may be the same word.
struct Wrap {
    WrittenWord first, last;
    std::string front, behind;
};

struct Cure {
    std::vector<Wrap> wraps;
    std::string reason; ///< a sentence: what it changes, and what stays
};

/// The text with all cures in it, each at the places of the text as it is now. Inner wraps come to stand
/// inside of outer ones, whatever the order. Nothing where a word is not where it should be.
std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures);

/// The same of a text that was put together from files: wherever it holds the words. False, and unchanged,
/// where it holds some of a wrap's and not the others.
bool apply(text::MappedText& text, std::span<const Cure> cures);

} // namespace tidemark::glsl
