// An error with the line that it is about, as the overlay shows it. Reads no file.
#pragma once

#include "base/error.hpp"

#include <string>
#include <string_view>

namespace tidemark::live {

struct ErrorField {
    Diagnostic diagnostic;
    std::string line{}; ///< the author's; empty: not known
};

/// A piece of a line with the place in it that is meant.
struct Excerpt {
    std::string text; ///< no tabs
    std::string mark; ///< blanks and a caret for the line below; empty: no place
};

/// At most so many characters of the line, with those round `column` (in bytes, from 1; 0: none) among them.
Excerpt excerpt_of(std::string_view line, int column, size_t most);

} // namespace tidemark::live
