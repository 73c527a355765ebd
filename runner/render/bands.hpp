// Draws a frame tile by tile. Each row of tiles is a band; the bands come from the top, in the row order of
// files.
#pragma once

#include "render/exposure.hpp"
#include "render/renderer.hpp"

#include <functional>

namespace tidemark::render {

/// Called before each tile, once per sample; returns false to stop.
using BeforeTile = std::function<bool()>;
/// Consumes a band and returns an image of any size whose memory the next band may use. One band can thus be
/// encoded while the next is drawn, and memory holds two at most.
using TakeBand = std::function<Result<image::Image>(image::Image band)>;

/// Draws all bands after the `draw` of the same frame. The renderer must have tiles; for several samples its
/// samples must be floats. Redraws the inputs of the shown pass for each sample when the samples have
/// different times. Returns false when it was stopped.
Result<bool> draw_bands(Renderer& renderer, const ExposedFrame& frame, const BeforeTile& before_tile,
                        const TakeBand& take);

/// Returns all bands as one picture; nothing when it was stopped.
std::optional<image::Image> draw_in_tiles(Renderer& renderer, const ExposedFrame& frame,
                                          const BeforeTile& before_tile);
image::Image draw_in_tiles(Renderer& renderer, const FrameInputs& inputs);

} // namespace tidemark::render
