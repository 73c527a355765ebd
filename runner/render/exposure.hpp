// A frame as the mean of several: of places within each pixel, against jagged edges, and of moments while a
// shutter is open, for motion blur.
#pragma once

#include "render/frame_state.hpp"

#include <vector>

namespace tidemark::render {

inline constexpr int k_most_samples = 1 << 16;

struct Exposure {
    int samples = 1;      ///< up to k_most_samples
    double shutter = 0;   ///< how long it is open, from the frame's own time on, as a part of a frame
    bool clamped = false; ///< colours beyond 0 to 1 count as what a display shows of them

    bool several() const { return samples > 1; }
};

/// One picture of a frame's exposure.
struct Sample {
    FrameInputs inputs;
    double x = 0, y = 0; ///< from the middle of the pixels, in pixels
};

struct ExposedFrame {
    std::vector<Sample> samples;
    bool moving = false;  ///< each has a time of its own
    bool clamped = false; ///< as in Exposure
};

/// The places are those of a Hammersley set, which lie evenly in every part of the pixel and of the time (J.
/// M. Hammersley: Monte Carlo methods for solving multivariable problems, 1960); moved so that their mean is
/// the middle of the pixel. The same for every pixel and frame.
ExposedFrame expose(const Exposure& exposure, const FrameState& state);

} // namespace tidemark::render
