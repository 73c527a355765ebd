// Applies text changes to a scene: a scene and changes in, a changed copy out. It writes no files.
#pragma once

#include "glsl/cure/cure.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <span>

namespace tidemark::lab {

/// Returns the scene with all changes applied, or nothing if a text does not contain the tokens to change or
/// two changes overlap.
std::optional<scene::Scene> changed(scene::Scene scene, std::span<const glsl::Cure> changes);

} // namespace tidemark::lab
