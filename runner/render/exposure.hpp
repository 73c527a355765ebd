// Describes a frame as the mean of several: of places within each pixel for antialiasing, and of moments
// while a shutter is open for motion blur.
#pragma once

#include "render/frame_state.hpp"
#include "render/renderer.hpp"

#include <functional>
#include <vector>

namespace tidemark::render {

inline constexpr int k_most_samples = 1 << 16;

struct Exposure {
    int samples = 1;      ///< up to k_most_samples
    double shutter = 0;   ///< opening time from the frame's own time on, in frames
    bool clamped = false; ///< colours beyond 0 to 1 count as displayed: clamped

    bool several() const { return samples > 1; }
};

/// One picture of a frame's exposure.
struct Sample {
    FrameInputs inputs;
    double x = 0, y = 0; ///< offset from the pixel centres, in pixels
};

struct ExposedFrame {
    std::vector<Sample> samples;
    bool moving = false;  ///< samples have different times
    bool clamped = false; ///< as in Exposure
};

/// Chooses the samples of a frame. Their places are a Hammersley set, which covers pixel and time evenly (J.
/// M. Hammersley: Monte Carlo methods for solving multivariable problems, 1960), shifted so that the mean is
/// the pixel's centre. The set is the same for every pixel and frame.
ExposedFrame expose(const Exposure& exposure, const FrameState& state);

// Draws a frame tile by tile. Each row of tiles is a band; the bands come from the top, in the row order of
// files.

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
