#include "platform/window_loss.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <utility>

namespace tidemark::platform {
namespace {

std::function<void()> at_the_end; // Xlib hands its handler nothing but the display

/// Xlib ends the process when it returns.
int handle_loss(void*) {
    static std::atomic<bool> begun = false;
    if (begun.exchange(true))
        ::pause(); // another thread is at it
    if (at_the_end)
        at_the_end();
    return 0;
}

} // namespace

WhenDisplayIsLost::WhenDisplayIsLost(std::function<void()> act) {
    // GLFW's copy, where it has one: the program itself does not need Xlib.
    void* const xlib = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!xlib)
        return;
    using Handler = int (*)(void* display);
    const auto set_handler = reinterpret_cast<Handler (*)(Handler)>(::dlsym(xlib, "XSetIOErrorHandler"));
    at_the_end = std::move(act);
    if (set_handler)
        set_handler(handle_loss);
    ::dlclose(xlib); // GLFW keeps it
}

WhenDisplayIsLost::~WhenDisplayIsLost() {
    at_the_end = nullptr;
}

} // namespace tidemark::platform
