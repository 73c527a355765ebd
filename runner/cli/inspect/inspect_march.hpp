// The marching loops that are found in a pass, for `inspect`.
#pragma once

#include "cli/json_dump.hpp"
#include "scene/scene.hpp"

#include <string>

namespace tidemark::cli {

/// Returns one line for each loop; empty if the pass has none or cannot be analysed.
std::string march_lines(const scene::Scene& scene, const scene::Pass& pass);
/// Returns [{"file", "line", "kind"}], or {"not_followed": reason}.
Json marches_of(const scene::Scene& scene, const scene::Pass& pass);

} // namespace tidemark::cli
