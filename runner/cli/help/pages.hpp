// The pages that lie beside the code, as they were when the program was built (runner/CMakeLists.txt).
#pragma once

#include <span>
#include <string_view>

namespace tidemark::cli {

/// The Markdown of each, those of the command line first.
std::span<const std::string_view> help_pages();

} // namespace tidemark::cli
