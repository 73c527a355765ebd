// The numbers that a person can turn by name in a scene's own files.
#pragma once

#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <vector>

namespace tidemark::lab {

/// Definitions, but for those of files that the scene includes, then knobs.
std::vector<scene::Setting> own_numbers(const scene::Scene& scene);

} // namespace tidemark::lab
