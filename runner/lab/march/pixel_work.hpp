// Measures how much a pass computes: the operations that its text executes, counted on the CPU. The result
// does not depend on the machine or its driver.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

namespace tidemark::lab {

struct PixelWork {
    double operations = 0; ///< scalar operations per pixel: the mean
    size_t pixels = 0; ///< number of pixels counted, on a grid
};

/// Counts for a pass in the frame that the renderer has drawn from those inputs, for up to 1.5 seconds. Fails
/// if the text is not supported.
Result<PixelWork> count_work(const render::Renderer& renderer, size_t pass,
                             const render::FrameInputs& inputs);

} // namespace tidemark::lab
