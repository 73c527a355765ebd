// A change of a source text as a plain value: text to insert before and after an author's tokens, or to
// replace them with. Applies such changes to a text; does not find them.
#pragma once

#include "base/error.hpp"
#include "text/mapped_text.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// A token and its place in the author's file.
struct WrittenWord {
    SourceLocation where;
    std::string word;
    bool operator==(const WrittenWord&) const = default;
};

/// Inserts `front` before the first token and `behind` after the last. Both may be the same token.
struct Wrap {
    WrittenWord first, last;
    std::string front, behind;
    bool replaces = false; ///< `front` replaces the tokens
    bool operator==(const Wrap&) const = default;
};

struct Cure {
    std::vector<Wrap> wraps;
    std::string reason; ///< a sentence that says what changes and what stays
    bool operator==(const Cure&) const = default;
};

/// Returns the text with all cures applied, each at places of the original text. Inner wraps are nested in
/// outer ones in any order of cures; a change inside replaced text is dropped. Returns nothing if a token is
/// not at its place, or if two changes overlap and neither is inside the other.
std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures);

/// Applies the cures to a text assembled from files, at every place that holds the tokens. Returns false, and
/// changes nothing, if the text holds some tokens of a wrap but not the others.
bool apply(text::MappedText& text, std::span<const Cure> cures);

} // namespace tidemark::glsl
