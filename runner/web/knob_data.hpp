// A knob as JSON, from which host/controls.js makes its widgets.
#pragma once

#include "scene/knob.hpp"
#include "web/json.hpp"

namespace tidemark::web {

Json knob_data(const scene::Knob& knob);

} // namespace tidemark::web
