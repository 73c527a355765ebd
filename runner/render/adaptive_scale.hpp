// The render scale that holds a frame rate. In goes what each frame took, out comes the scale of the next
// one: down soon, up late, and never for a few slow frames.
#pragma once

#include "render/render_scale.hpp"

#include <deque>
#include <optional>

namespace tidemark::render {

class AdaptiveScale {
public:
    explicit AdaptiveScale(double fps) : budget_(1000 / fps) {}

    /// After a frame in that scale.
    RenderScale after_frame(RenderScale scale, double milliseconds);
    /// What was measured says nothing of the frames to come.
    void forget();

private:
    std::optional<RenderScale> lower(RenderScale scale) const;
    std::optional<RenderScale> higher(RenderScale scale);

    double budget_;                        ///< milliseconds of a frame
    std::deque<double> recent_;            ///< of frames in one scale, the last one at the back
    double growth_ = k_pixels;             ///< of a frame's time, for twice as many pixels along a side
    std::optional<double> before_step_up_; ///< milliseconds, while that step may turn out to be wrong

    static constexpr double k_pixels = 4;
};

} // namespace tidemark::render
