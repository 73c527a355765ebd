#include "platform/window_loss.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <utility>

namespace tidemark::platform {
namespace {

std::function<void(std::string_view)> at_the_end; // global, because Xlib passes no user data to its handlers

/// Calls the action once; if that returns, Xlib or the caller ends the process.
void lose(std::string_view what) {
    static std::atomic<bool> begun = false;
    if (begun.exchange(true))
        ::pause(); // another thread is doing it
    if (at_the_end)
        at_the_end(what);
}

/// Xlib's XErrorEvent.
struct ErrorEvent {
    int type;
    void* display;
    unsigned long resource;
    unsigned long serial;
    unsigned char code, request, minor;
};

using LossHandler = int (*)(void* display);
using ErrorHandler = int (*)(void* display, ErrorEvent* error);
ErrorHandler handler_before = nullptr;

/// Xlib ends the process when this returns.
int handle_loss(void*) {
    lose("the display is gone");
    return 0;
}

/// Handles errors that follow when another program has destroyed the window: all uses of it fail then.
int handle_error(void* display, ErrorEvent* error) {
    constexpr unsigned char k_bad_window = 3, k_bad_drawable = 9, k_first_of_extensions = 128;
    if (error->code == k_bad_window || error->code == k_bad_drawable || error->code >= k_first_of_extensions)
        lose("another program has destroyed the window");
    return handler_before ? handler_before(display, error) : 0;
}

} // namespace

WhenDisplayIsLost::WhenDisplayIsLost(std::function<void(std::string_view what)> act) {
    // The copy that GLFW has loaded, if any: the program itself does not need Xlib.
    void* const xlib = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!xlib)
        return;
    at_the_end = std::move(act);
    const auto set_loss_handler =
        reinterpret_cast<LossHandler (*)(LossHandler)>(::dlsym(xlib, "XSetIOErrorHandler"));
    const auto set_error_handler =
        reinterpret_cast<ErrorHandler (*)(ErrorHandler)>(::dlsym(xlib, "XSetErrorHandler"));
    if (set_loss_handler)
        set_loss_handler(handle_loss);
    if (set_error_handler)
        if (const ErrorHandler before = set_error_handler(handle_error); before != handle_error)
            handler_before = before;
    ::dlclose(xlib); // GLFW keeps it loaded
}

WhenDisplayIsLost::~WhenDisplayIsLost() {
    at_the_end = nullptr;
}

} // namespace tidemark::platform
