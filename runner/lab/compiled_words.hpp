// What a driver's preprocessor leaves of a scene: whether two texts are one program. Pure.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The words of all passes, blanks, comments and what #if takes out aside; nothing where that cannot be told
/// without the driver. Values of knobs are in none of them.
std::optional<std::vector<std::string>> compiled_words(const scene::Scene& scene);

} // namespace tidemark::lab
