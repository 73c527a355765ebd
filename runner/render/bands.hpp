// A frame that is drawn tile by tile, as the bands that its tiles make: from the top, as files have their
// rows.
#pragma once

#include "render/exposure.hpp"
#include "render/renderer.hpp"

#include <functional>

namespace tidemark::render {

/// Is told before each tile, once for each sample; false stops there.
using BeforeTile = std::function<bool()>;
/// Takes a band and gives one back, of whatever size, for the next to be drawn into: so one can be encoded
/// while the next is drawn, and two are all that memory holds.
using TakeBand = std::function<Result<image::Image>(image::Image band)>;

/// After the `draw` of the same frame, of a renderer that has tiles; where it has several samples, those of
/// floats. Where they have times of their own, what the shown pass reads is drawn anew for each. False:
/// stopped.
Result<bool> draw_bands(Renderer& renderer, const ExposedFrame& frame, const BeforeTile& before_tile,
                        const TakeBand& take);

/// The bands together; nothing where it was stopped.
std::optional<image::Image> draw_in_tiles(Renderer& renderer, const ExposedFrame& frame,
                                          const BeforeTile& before_tile);
image::Image draw_in_tiles(Renderer& renderer, const FrameInputs& inputs);

} // namespace tidemark::render
