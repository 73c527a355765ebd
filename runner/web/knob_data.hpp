// A knob as JSON, from which host/controls.js makes its widget.
#pragma once

#include "scene/knob.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tidemark::web {

nlohmann::ordered_json knob_data(const scene::Knob& knob);

} // namespace tidemark::web
