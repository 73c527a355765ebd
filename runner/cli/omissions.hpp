// What a scene does not need and therefore was not made.
#pragma once

#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

struct SceneFacts {
    std::vector<std::string> uniforms; ///< active ones of the host, knobs and channels included
    std::vector<int> channels;         ///< read by the linked program
    std::vector<std::string> left_out; ///< for people, one thing each
};

SceneFacts facts_of(const render::Renderer& renderer);

} // namespace tidemark::cli
