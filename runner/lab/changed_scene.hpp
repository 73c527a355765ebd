// A scene with its texts changed.
#pragma once

#include "glsl/cure/cure.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <span>

namespace tidemark::lab {

/// Nothing where a text has not the words, or where two changes overlap.
std::optional<scene::Scene> changed(scene::Scene scene, std::span<const glsl::Cure> changes);

} // namespace tidemark::lab
