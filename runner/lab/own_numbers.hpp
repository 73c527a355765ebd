// The named numbers of a scene that its user may change.
#pragma once

#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <vector>

namespace tidemark::lab {

/// Returns the definitions whose value is one number, then the knobs. Of a scene that is a single file
/// (bare_file), definitions of included files are left out.
std::vector<scene::Setting> own_numbers(const scene::Scene& scene);

} // namespace tidemark::lab
