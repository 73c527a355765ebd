// Handles the loss of the window: the X server dies, the connection breaks, or another program destroys the
// window.
#pragma once

#include <functional>
#include <string_view>

namespace tidemark::platform {

/// While this object exists, `act` is called once when the window is lost, on the thread that notices, with a
/// description; the process ends when it returns. There must be a Window. On Wayland the window is asked to
/// close instead.
class WhenDisplayIsLost {
public:
    explicit WhenDisplayIsLost(std::function<void(std::string_view what)> act);
    ~WhenDisplayIsLost();
    WhenDisplayIsLost(const WhenDisplayIsLost&) = delete;
    WhenDisplayIsLost& operator=(const WhenDisplayIsLost&) = delete;
};

} // namespace tidemark::platform
