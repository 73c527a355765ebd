// The list of views that the user kept.
#pragma once

#include "live/command.hpp"

#include <string>
#include <vector>

namespace tidemark::live {

void draw_views(const std::vector<std::string>& views, Commands& commands);

} // namespace tidemark::live
