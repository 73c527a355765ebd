#include "lab/changed_scene.hpp"

namespace tidemark::lab {

std::optional<scene::Scene> changed(scene::Scene scene, std::span<const glsl::Cure> changes) {
    if (!glsl::apply(scene.common, changes))
        return std::nullopt;
    for (scene::Pass& pass : scene.passes)
        if (!glsl::apply(pass.text, changes))
            return std::nullopt;
    return scene;
}

} // namespace tidemark::lab
