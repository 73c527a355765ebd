// Where a window is to open, as values.
#pragma once

#include "base/extent.hpp"

#include <optional>

namespace tidemark::platform {

/// Of a window on the screen: its left upper corner in the window system's coordinates, its size in pixels of
/// an ordinary display.
struct WindowPlace {
    int x = 0;
    int y = 0;
    Extent size;
};

/// From the left upper corner of the screen or of a monitor, in the window system's coordinates.
struct ScreenPoint {
    int x = 0;
    int y = 0;
};

/// Where a window opens, and how it stands to the others. Not every system lets a program choose its place.
struct WindowWishes {
    std::optional<WindowPlace> left_at{};  ///< the last one of its kind, if a monitor still shows that
    std::optional<int> monitor{};          ///< 1 is the first; in its middle
    std::optional<ScreenPoint> position{}; ///< the left upper corner, on that monitor if there is one
    bool on_top = false;                   ///< stays above the others
};

} // namespace tidemark::platform
