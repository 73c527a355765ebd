// The times of each pass in a window's frames, by the driver's timer. Used only while they are shown or
// needed.
#pragma once

#include "render/renderer.hpp"

#include <map>
#include <optional>
#include <vector>

namespace tidemark::cli {

class PassCosts {
public:
    /// Returns the timers for the next frame, after it has read those of the frame before, which is complete
    /// by now.
    std::vector<render::PassTimer>* next_frame();
    /// Records the time of a pass of the last frame that was drawn in parts, without timers.
    void took(size_t pass, double milliseconds);
    void forget();
    /// Returns the milliseconds of the pass when it was last drawn.
    std::optional<double> of(size_t pass) const;
    /// Returns the milliseconds of the frame before the one that `next_frame` was called for; none: nothing
    /// was drawn.
    std::optional<double> frame_before() const { return frame_before_; }

private:
    std::vector<render::PassTimer> timers_;
    std::map<size_t, double> milliseconds_;
    std::optional<double> frame_before_;
    std::optional<double> in_parts_; ///< of a frame drawn in parts, for the next call of next_frame
};

} // namespace tidemark::cli
