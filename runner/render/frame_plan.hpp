// Which passes are drawn in which order, and which inputs each of them reads. Pure: what the scene says and
// what the driver kept decide.
#pragma once

#include "gl/program.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace tidemark::render {

struct PlannedPass {
    size_t pass = 0;           ///< index into Scene::passes
    std::vector<int> channels; ///< those the linked program reads, ascending
};

struct FramePlan {
    std::vector<PlannedPass> passes; ///< in the order of drawing
};

/// `reflections` has one entry for each pass of the scene.
FramePlan plan_frame(const scene::Scene& scene, const std::vector<gl::Reflection>& reflections);

} // namespace tidemark::render
