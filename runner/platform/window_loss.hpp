// The end of a window that nobody here has closed: an X server that dies, a connection that breaks, another
// program that destroys it.
#pragma once

#include <functional>
#include <string_view>

namespace tidemark::platform {

/// While it lives `act` is called when that happens, once, on whichever thread notices, with what has
/// happened in words; the process ends when it returns. There must be a Window. Wayland asks the window to
/// close instead.
class WhenDisplayIsLost {
public:
    explicit WhenDisplayIsLost(std::function<void(std::string_view what)> act);
    ~WhenDisplayIsLost();
    WhenDisplayIsLost(const WhenDisplayIsLost&) = delete;
    WhenDisplayIsLost& operator=(const WhenDisplayIsLost&) = delete;
};

} // namespace tidemark::platform
