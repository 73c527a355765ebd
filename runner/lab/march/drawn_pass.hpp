// A pass as a function, with the frame that its uniforms come from.
#pragma once

#include "lab/march/pass_function.hpp"

namespace tidemark::lab {

struct DrawnPass {
    const PassFunction& function;
    const render::Renderer& renderer; ///< has drawn the frame
    size_t pass = 0;
    render::FrameInputs inputs;
};

} // namespace tidemark::lab
