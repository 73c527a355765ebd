// The end of the display under a window: an X server that dies, or a connection that breaks.
#pragma once

#include <functional>

namespace tidemark::platform {

/// While it lives `act` is called when that happens, once, on whichever thread notices; the process ends when
/// it returns. There must be a Window. Wayland asks the window to close instead.
class WhenDisplayIsLost {
public:
    explicit WhenDisplayIsLost(std::function<void()> act);
    ~WhenDisplayIsLost();
    WhenDisplayIsLost(const WhenDisplayIsLost&) = delete;
    WhenDisplayIsLost& operator=(const WhenDisplayIsLost&) = delete;
};

} // namespace tidemark::platform
