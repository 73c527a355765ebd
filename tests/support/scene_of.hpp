// A scene that is nowhere but in a test.
#pragma once

#include "scene/directives.hpp"
#include "scene/scene.hpp"

#include <string_view>

namespace tidemark {

/// One pass, written in `a.glsl`.
inline scene::Scene scene_of(std::string_view text) {
    scene::Scene scene;
    scene.passes.resize(1);
    scene.passes[0].text.append(text, "a.glsl", 1);
    if (auto directives = scene::take_directives(scene.passes[0].text))
        scene.knobs = std::move(directives->knobs);
    return scene;
}

} // namespace tidemark
