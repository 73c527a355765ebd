// The marching loops that are found in a pass, for `inspect`.
#pragma once

#include "cli/json_dump.hpp"
#include "scene/scene.hpp"

#include <string>

namespace tidemark::cli {

/// A line for each loop; nothing of a text that has none or cannot be followed.
std::string march_lines(const scene::Scene& scene, const scene::Pass& pass);
/// [{"file", "line", "kind"}], or {"not_followed": why}.
Json marches_of(const scene::Scene& scene, const scene::Pass& pass);

} // namespace tidemark::cli
