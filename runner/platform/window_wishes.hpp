// The requested place of a window, as values.
#pragma once

#include "base/extent.hpp"

#include <optional>

namespace tidemark::platform {

/// A window's place on the screen: its upper left corner in the window system's coordinates, its size in
/// pixels of an ordinary display.
struct WindowPlace {
    int x = 0;
    int y = 0;
    Extent size;
};

/// A point, from the upper left corner of the screen or of a monitor, in the window system's coordinates.
struct ScreenPoint {
    int x = 0;
    int y = 0;
};

/// Requested place and stacking of a window. Not every system lets a program choose the place.
struct WindowWishes {
    /// place of the last window of its kind, used if a monitor still shows it
    std::optional<WindowPlace> left_at{};
    std::optional<int> monitor{};          ///< 1 is the first; the window is centred on it
    std::optional<ScreenPoint> position{}; ///< the upper left corner, on `monitor` if that is set
    bool on_top = false;                   ///< stays above other windows
};

} // namespace tidemark::platform
