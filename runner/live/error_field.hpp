// An error with the source line it refers to, as the overlay shows it. Reads no file.
#pragma once

#include "base/error.hpp"

#include <string>
#include <string_view>

namespace tidemark::live {

struct ErrorField {
    Diagnostic diagnostic;
    std::string line{}; ///< the author's source line; empty: not known
};

/// A part of a line that contains the place of an error.
struct Excerpt {
    std::string text; ///< without tabs
    std::string mark; ///< blanks and a caret for the line below; empty: no column is known
};

/// Returns at most `most` characters of the line, including those around `column` (in bytes, from 1; 0:
/// none).
Excerpt excerpt_of(std::string_view line, int column, size_t most);

} // namespace tidemark::live
