// Whether a frame can be drawn in one go without anybody waiting for the window, or is better drawn in parts.
// Pure: told what frames took.
#pragma once

#include "base/extent.hpp"

#include <optional>

namespace tidemark::render {

class FramePace {
public:
    enum class Way { whole, in_parts };

    /// What the next frame of that size should take, in seconds; nothing: not known.
    std::optional<double> expected(Extent extent) const;
    /// For the next frame, of that size. In parts where nothing is known.
    Way way(Extent extent) const;
    /// A frame of that size was drawn, in that way, in so many seconds.
    void took(Extent extent, Way way, double seconds);
    /// What is known need not be true of the next frame.
    void doubt() { seconds_of_pixel_.reset(); }

private:
    std::optional<double> seconds_of_pixel_; ///< none: not known
    Way last_ = Way::in_parts;
};

} // namespace tidemark::render
