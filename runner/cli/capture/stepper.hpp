// Draws frame N of a scene, whatever was drawn before: where a frame depends on the one before it, all frames
// from 0 are drawn on the way; otherwise it jumps.
#pragma once

#include "render/renderer.hpp"

#include <functional>

namespace tidemark::cli {

class Stepper {
public:
    using InputsOfFrame = std::function<render::FrameInputs(int frame)>;

    Stepper(render::Renderer& renderer, InputsOfFrame inputs_of)
        : renderer_(renderer), inputs_of_(std::move(inputs_of)) {}

    /// Draws `frame`. `before_step(frame, last)` is called before each frame that is drawn on the way and
    /// before the last one; false stops there.
    bool draw(int frame, const std::function<bool(int frame, int last)>& before_step);

private:
    render::Renderer& renderer_;
    InputsOfFrame inputs_of_;
    int next_ = 0; ///< the frame that the buffers are ready for
};

} // namespace tidemark::cli
