// Fields below the small pictures: how the large one is looked at.
#pragma once

#include "live/plugin/panels.hpp"

namespace tidemark::live {

/// Nothing where no picture is large.
void draw_look(const Model& model, Commands& commands);

} // namespace tidemark::live
