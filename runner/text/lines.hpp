// Splits a text into lines.
#pragma once

#include <string_view>
#include <vector>

namespace tidemark::text {

/// Returns the lines without their line ends, as views into the text. A last line without a line end counts
/// if it is not empty.
std::vector<std::string_view> lines_of(std::string_view text);

} // namespace tidemark::text
