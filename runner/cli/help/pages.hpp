// The manual pages next to the code, embedded when the program is built (runner/CMakeLists.txt).
#pragma once

#include <span>
#include <string_view>

namespace tidemark::cli {

/// Returns the Markdown of each page, the command line's pages first.
std::span<const std::string_view> help_pages();

} // namespace tidemark::cli
