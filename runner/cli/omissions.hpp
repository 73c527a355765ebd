// Lists what a scene does not need and what was therefore not created.
#pragma once

#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// A drawn pass and the channels that its program reads.
struct PassFacts {
    size_t pass = 0; ///< index into Scene::passes
    std::vector<int> channels;
};

struct SceneFacts {
    std::vector<PassFacts> passes;     ///< in drawing order
    std::vector<std::string> uniforms; ///< active in any pass, knobs and channels included
    std::vector<std::string> left_out; ///< texts for users, one per kind
};

SceneFacts facts_of(const render::Renderer& renderer);

/// Returns what specialisation of kind `how` removes from a pass's text; in double precision, what was
/// removed when the pass was compiled.
glsl::LeftOut left_out_of(const render::Renderer& renderer, size_t pass, glsl::Specialise how);

} // namespace tidemark::cli
