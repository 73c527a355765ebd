// What a scene does not need and therefore was not made.
#pragma once

#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// A pass that is drawn and the channels that its program reads.
struct PassFacts {
    size_t pass = 0; ///< index into Scene::passes
    std::vector<int> channels;
};

struct SceneFacts {
    std::vector<PassFacts> passes;     ///< in the order of drawing
    std::vector<std::string> uniforms; ///< active in any of them, knobs and channels included
    std::vector<std::string> left_out; ///< for people, one thing each
};

SceneFacts facts_of(const render::Renderer& renderer);

/// What specialising as far as `how` takes out of a pass's text; of a promoted scene, what was taken out.
glsl::LeftOut left_out_of(const render::Renderer& renderer, size_t pass, glsl::Specialise how);

} // namespace tidemark::cli
