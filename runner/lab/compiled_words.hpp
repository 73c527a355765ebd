// The tokens of a scene's passes after preprocessing, used to check whether two texts compile to the same
// program. Pure; needs no driver.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Returns the tokens of all passes in order, without white space, comments and text that #if removes, or
/// nothing if the text cannot be preprocessed without the driver. Knob values are uniforms, so the tokens do
/// not contain them.
std::optional<std::vector<std::string>> compiled_words(const scene::Scene& scene);

} // namespace tidemark::lab
