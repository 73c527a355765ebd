// Chooses the render scale that holds a frame rate, from the time of each frame. The scale falls soon, rises
// late, and ignores a few slow frames.
#pragma once

#include "render/render_scale.hpp"

#include <deque>
#include <optional>

namespace tidemark::render {

class AdaptiveScale {
public:
    explicit AdaptiveScale(double fps) : budget_(1000 / fps) {}

    /// Returns the scale of the next frame after a frame in `scale` took that long.
    RenderScale after_frame(RenderScale scale, double milliseconds);
    /// Discards all measurements; for changes after which frames may take a different time.
    void forget();

private:
    std::optional<RenderScale> lower(RenderScale scale) const;
    std::optional<RenderScale> higher(RenderScale scale);

    double budget_;                        ///< milliseconds per frame
    std::deque<double> recent_;            ///< times of frames in the current scale, the newest last
    double growth_ = k_pixels;             ///< factor of a frame's time for twice as many pixels along a side
    std::optional<double> before_step_up_; ///< milliseconds; set while the last step up may still be undone

    static constexpr double k_pixels = 4;
};

} // namespace tidemark::render
