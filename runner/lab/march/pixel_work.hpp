// How much a pass computes: the operations that its text executes, counted on the CPU. The same on every
// machine, whatever its driver makes of the text.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

namespace tidemark::lab {

struct PixelWork {
    double operations = 0; ///< of scalars, a pixel: the mean
    size_t pixels = 0;     ///< that were counted, on a grid
};

/// Of a pass, in the frame that the renderer has drawn from those inputs; as many pixels as some seconds
/// allow. Fails where the text cannot be followed.
Result<PixelWork> count_work(const render::Renderer& renderer, size_t pass,
                             const render::FrameInputs& inputs);

} // namespace tidemark::lab
