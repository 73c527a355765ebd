// A text as its lines.
#pragma once

#include <string_view>
#include <vector>

namespace tidemark::text {

/// Without their ends; views into the text. What stands behind the last end is a line if it is not empty.
std::vector<std::string_view> lines_of(std::string_view text);

} // namespace tidemark::text
