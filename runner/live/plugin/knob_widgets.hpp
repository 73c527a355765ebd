// Widgets for the knobs of a scene.
#pragma once

#include "live/command.hpp"
#include "live/knob_field.hpp"

#include <vector>

namespace tidemark::live {

void draw_knobs(std::vector<KnobField>& fields, Commands& commands);

} // namespace tidemark::live
