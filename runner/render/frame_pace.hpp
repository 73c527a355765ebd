// Decides whether a frame is drawn in one go without a noticeable delay of the window, or in parts. Pure: the
// input is the time of earlier frames.
#pragma once

#include "base/extent.hpp"

#include <optional>

namespace tidemark::render {

class FramePace {
public:
    enum class Way { whole, in_parts };

    /// Returns the expected seconds of the next frame of that size; nothing when unknown.
    std::optional<double> expected(Extent extent) const;
    /// Returns the way to draw the next frame of that size: in parts when its time is unknown.
    Way way(Extent extent) const;
    /// Records the seconds of a frame of that size, drawn in that way.
    void took(Extent extent, Way way, double seconds);
    /// Discards the measurement; for changes after which frames may take a different time.
    void doubt() { seconds_of_pixel_.reset(); }

private:
    std::optional<double> seconds_of_pixel_; ///< empty: unknown
    Way last_ = Way::in_parts;
};

} // namespace tidemark::render
