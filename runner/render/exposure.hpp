// Describes a frame as the mean of several: of places within each pixel for antialiasing, and of moments
// while a shutter is open for motion blur.
#pragma once

#include "render/frame_state.hpp"

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

} // namespace tidemark::render
