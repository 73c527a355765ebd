// A change of a text, as a plain value: what is to be written in front of and behind words of its author's,
// or in their place; and how that is put into a text. A cure of a fault takes no word away, a cut does.
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
    bool operator==(const WrittenWord&) const = default;
};

/// `front` before the first word, `behind` after the last. Both may be the same word.
struct Wrap {
    WrittenWord first, last;
    std::string front, behind;
    bool replaces = false; ///< the words between go
    bool operator==(const Wrap&) const = default;
};

struct Cure {
    std::vector<Wrap> wraps;
    std::string reason; ///< a sentence: what it changes, and what stays
    bool operator==(const Cure&) const = default;
};

/// The text with all cures in it, each at the places of the text as it is now. Inner wraps come to stand
/// inside of outer ones, whatever the order; what is changed inside of words that go goes with them. Nothing
/// where a word is not where it should be, or where two overlap and neither is inside.
std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures);

/// The same of a text that was put together from files: wherever it holds the words. False, and unchanged,
/// where it holds some of a wrap's and not the others.
bool apply(text::MappedText& text, std::span<const Cure> cures);

} // namespace tidemark::glsl
