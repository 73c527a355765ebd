#include "window/window.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "render/gl_context.hpp"
#include "window/glfw.hpp"

#include <EGL/egl.h>
#include <dlfcn.h>
#include <unistd.h>

#include <atomic>

#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace tidemark::window {

using namespace host;
namespace {

/// Starts nothing; its destructor terminates GLFW.
struct Library {
    Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { glfwTerminate(); }
};

tl::unexpected<Error> cannot_open(std::string_view why) {
    return fail(ErrorCode::no_context,
                fmt::format("cannot open a window: {}; `tidemark capture` draws without one", why));
}

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

/// Returns whether GLFW runs. GLFW has no function for that, but glfwGetTime fails if it does not.
bool library_runs() {
    glfwGetError(nullptr);
    glfwGetTime();
    return glfwGetError(nullptr) != GLFW_NOT_INITIALIZED;
}

/// Opens it hidden, because it is moved first.
GLFWwindow* open_window(Extent size, const char* title, const WindowWishes& wishes, ResetNotice notice) {
    hint_window(wishes.es);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS,
                   notice == ResetNotice::yes ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS);
    glfwWindowHint(GLFW_FLOATING, wishes.on_top ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    return glfwCreateWindow(size.width, size.height, title, nullptr, nullptr);
}

/// Returns 0 on Wayland: there a swap that waits would wait for a hidden window to be shown and block events
/// and Ctrl-C. Wayland compositors do not tear, and frames follow our own clock in any case.
int swap_interval() {
    const bool wayland = is_set("WAYLAND_DISPLAY") &&
                         std::string_view(glfwGetVersionString()).find("Wayland") != std::string_view::npos;
    return wayland ? 0 : 1;
}

Button button_from_glfw(int button) {
    return button == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
           : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                               : Button::middle;
}

/// Reports changes of size, requests to redraw and to close as events of `state`, the window's user pointer.
template <class State>
void listen_to_frame(State& state) {
    GLFWwindow* handle = state.window.get();
    glfwSetWindowUserPointer(handle, &state);
    glfwGetFramebufferSize(handle, &state.framebuffer.width, &state.framebuffer.height);
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* source, int width, int height) {
        State& resized = State::of(source);
        resized.framebuffer = {width, height};
        resized.events.emplace_back(FramebufferResized{resized.framebuffer});
    });
    glfwSetWindowRefreshCallback(
        handle, [](GLFWwindow* source) { State::of(source).events.emplace_back(RedrawNeeded{}); });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* source) {
        glfwSetWindowShouldClose(source, GLFW_FALSE);
        State::of(source).events.emplace_back(CloseRequested{});
    });
}

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
    lose("the connection to the display is lost");
    return 0;
}

/// Handles errors that follow when another program has destroyed the window: all uses of it fail then.
int handle_error(void* display, ErrorEvent* error) {
    constexpr unsigned char k_bad_window = 3, k_bad_drawable = 9, k_first_of_extensions = 128;
    constexpr unsigned char k_send_event = 25; // to the program that files were dragged from, which is gone
    if (error->request == k_send_event)
        return 0;
    if (error->code == k_bad_window || error->code == k_bad_drawable || error->code >= k_first_of_extensions)
        lose("another program has destroyed the window");
    return handler_before ? handler_before(display, error) : 0;
}

} // namespace

/// Keeps its address when the Window moves, since GLFW's user pointer points to it.
struct Window::State {
    Library library;
    GlfwWindow window;
    ResetNotice notice = ResetNotice::no;
    std::vector<InputEvent> events{};
    Extent framebuffer{};
    Extent screen{};     ///< the same area in GLFW's screen coordinates
    double cursor_x = 0; ///< in screen coordinates, origin at the top left
    double cursor_y = 0;
    ScreenArea before_full_screen{};

    /// Uses the sizes as of the events delivered so far: GLFW's own answers may be newer.
    PointerPosition pointer() const {
        const double scale_x = screen.width > 0 ? double(framebuffer.width) / screen.width : 1.0;
        const double scale_y = screen.height > 0 ? double(framebuffer.height) / screen.height : 1.0;
        return {cursor_x * scale_x, framebuffer.height - cursor_y * scale_y};
    }
    std::vector<InputEvent> take() { return std::exchange(events, {}); }

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    void listen() {
        GLFWwindow* handle = window.get();
        listen_to_frame(*this);
        glfwGetWindowSize(handle, &screen.width, &screen.height);
        glfwGetCursorPos(handle, &cursor_x, &cursor_y);
        glfwSetWindowSizeCallback(handle, [](GLFWwindow* source, int width, int height) {
            of(source).screen = {width, height};
        });
        glfwSetWindowFocusCallback(handle, [](GLFWwindow* source, int focused) {
            if (!focused)
                of(source).events.emplace_back(FocusLost{});
        });
        listen_to_user();
    }

    void listen_to_user() {
        GLFWwindow* handle = window.get();
        glfwSetCursorPosCallback(handle, [](GLFWwindow* source, double x, double y) {
            State& state = of(source);
            state.cursor_x = x;
            state.cursor_y = y;
            state.events.emplace_back(PointerMoved{state.pointer()});
        });
        glfwSetMouseButtonCallback(handle, [](GLFWwindow* source, int button, int action, int) {
            State& state = of(source);
            if (button > GLFW_MOUSE_BUTTON_MIDDLE)
                return;
            if (action == GLFW_PRESS)
                state.events.emplace_back(ButtonPressed{button_from_glfw(button), state.pointer()});
            else
                state.events.emplace_back(ButtonReleased{button_from_glfw(button), state.pointer()});
        });
        glfwSetDropCallback(handle, [](GLFWwindow* source, int count, const char** paths) {
            of(source).events.emplace_back(FilesDropped{{paths, paths + count}});
        });
        glfwSetScrollCallback(handle, [](GLFWwindow* source, double right, double up) {
            of(source).events.emplace_back(WheelTurned{right, up});
        });
        glfwSetCharCallback(handle, [](GLFWwindow* source, unsigned character) {
            of(source).events.emplace_back(TextTyped{char32_t(character)});
        });
        glfwSetKeyCallback(handle, [](GLFWwindow* source, int glfw_key, int scancode, int action, int) {
            if (const auto event = key_event(glfw_key, scancode, action))
                of(source).events.push_back(*event);
        });
    }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::create(Extent logical_size, const std::string& title, const WindowWishes& wishes) {
    assert(logical_size.width > 0 && logical_size.height > 0);
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
        return cannot_open("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
    if (library_runs())
        return cannot_open("this process has one already");
#ifdef GLFW_PLATFORM // GLFW 3.4 tries Wayland first, whose library writes to standard error
    glfwInitHint(GLFW_PLATFORM, is_set("WAYLAND_DISPLAY") ? GLFW_ANY_PLATFORM : GLFW_PLATFORM_X11);
#endif
    if (!glfwInit())
        return cannot_open(last_glfw_error());
    auto state = std::make_unique<State>();
    for (const ResetNotice notice : {ResetNotice::yes, ResetNotice::no}) {
        if (state->window)
            break;
        state->notice = notice;
        state->window.reset(open_window(logical_size, printable_line(title).c_str(), wishes, notice));
    }
    if (!state->window)
        return cannot_open(last_glfw_error());
    TRY(move_to_wished(state->window.get(), wishes));
    glfwShowWindow(state->window.get());
    glfwMakeContextCurrent(state->window.get());
    glfwSwapInterval(swap_interval());
    state->listen();
    return Window(std::move(state));
}

void Window::make_current() {
    glfwMakeContextCurrent(state_->window.get());
}

Result<SharedContext> Window::create_context() {
    GLFWwindow* window = state_->window.get();
    return SharedContext::create(glfwGetEGLDisplay(), glfwGetEGLContext(window), glfwGetEGLSurface(window),
                                 state_->notice);
}

std::vector<InputEvent> Window::poll() {
    glfwPollEvents();
    return state_->take();
}

std::vector<InputEvent> Window::wait(double seconds) {
    constexpr double k_as_good_as_forever = 1e6;
    if (seconds < k_as_good_as_forever)
        glfwWaitEventsTimeout(std::max(seconds, 0.0));
    else
        glfwWaitEvents();
    if (seconds > 0) { // a sleeping window does not use the display, so this checks that it still exists
        int width = 0, height = 0;
        glfwGetFramebufferSize(state_->window.get(), &width, &height);
    }
    return state_->take();
}

void Window::wake() {
    glfwPostEmptyEvent();
}

Extent Window::framebuffer_extent() const {
    return state_->framebuffer;
}

double Window::content_scale() const {
    float x = 1;
    float y = 1;
    glfwGetWindowContentScale(state_->window.get(), &x, &y);
    return std::max(x, y);
}

WindowPlace Window::place() const {
    const ScreenArea place = is_full_screen() ? state_->before_full_screen : place_of(state_->window.get());
    const Extent screen = state_->screen;
    const double pixels = screen.width > 0 ? double(state_->framebuffer.width) / screen.width : 1.0;
    const auto logical = [&](int length) {
        return std::max(1, int(std::lround(length * pixels / content_scale())));
    };
    return {place.x, place.y, {logical(place.width), logical(place.height)}};
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(state_->window.get(), text.c_str());
}

void Window::swap() {
    glfwSwapBuffers(state_->window.get());
}

void Window::set_title(const std::string& title) {
    // more than any title bar shows, less than X11's limit for one request
    constexpr size_t k_most_bytes = 1000;
    glfwSetWindowTitle(state_->window.get(), cut_text(printable_line(title), k_most_bytes).c_str());
}

bool Window::is_full_screen() const {
    return glfwGetWindowMonitor(state_->window.get()) != nullptr;
}

void Window::toggle_full_screen() {
    GLFWwindow* window = state_->window.get();
    if (glfwGetWindowMonitor(window)) {
        const ScreenArea& back = state_->before_full_screen;
        glfwSetWindowMonitor(window, nullptr, back.x, back.y, back.width, back.height, GLFW_DONT_CARE);
        return;
    }
    state_->before_full_screen = place_of(window);
    const Monitor monitor = monitor_under(state_->before_full_screen);
    if (monitor.handle)
        glfwSetWindowMonitor(window, monitor.handle, 0, 0, monitor.place.width, monitor.place.height,
                             monitor.refresh_rate);
}

/// Keeps its address when the OutputWindow moves, since GLFW's user pointer points to it.
struct OutputWindow::State {
    GlfwWindow window;
    std::vector<InputEvent> events{};
    Extent framebuffer{};

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    void listen() {
        listen_to_frame(*this);
        glfwSetKeyCallback(window.get(), [](GLFWwindow* source, int key, int scancode, int action, int) {
            if (const auto event = key_event(key, scancode, action))
                of(source).events.push_back(*event);
        });
    }
};

OutputWindow::OutputWindow(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputWindow::OutputWindow(OutputWindow&&) noexcept = default;
OutputWindow& OutputWindow::operator=(OutputWindow&&) noexcept = default;
OutputWindow::~OutputWindow() = default;

Result<OutputWindow> OutputWindow::create(const Window&, Extent logical_size, const std::string& title,
                                          std::optional<int> monitor) {
    Monitor screen;
    if (monitor)
        screen = TRY(monitor_numbered(*monitor, "--output-monitor"));
    auto state = std::make_unique<State>();
    const Extent size = monitor ? Extent{screen.place.width, screen.place.height} : logical_size;
    hint_window(gl::is_es());
    glfwWindowHint(GLFW_FOCUSED, GLFW_FALSE); // keys stay with the window that the user works in
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
    if (monitor)
        glfwWindowHint(GLFW_REFRESH_RATE, screen.refresh_rate);
    state->window.reset(
        glfwCreateWindow(size.width, size.height, printable_line(title).c_str(), screen.handle, nullptr));
    if (!state->window)
        return fail(ErrorCode::no_context, "cannot open the output window: " + last_glfw_error());
    if (monitor)
        glfwSetInputMode(state->window.get(), GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
    state->listen();
    return OutputWindow(std::move(state));
}

std::vector<InputEvent> OutputWindow::take_events() {
    return std::exchange(state_->events, {});
}

Extent OutputWindow::framebuffer_extent() const {
    return state_->framebuffer;
}

Result<void> OutputWindow::make_current() {
    EGLSurface surface = glfwGetEGLSurface(state_->window.get());
    if (!eglMakeCurrent(glfwGetEGLDisplay(), surface, surface, eglGetCurrentContext()))
        return fail(ErrorCode::no_context,
                    fmt::format("the output window cannot be drawn into: EGL error {:#06x}", eglGetError()));
    eglSwapInterval(glfwGetEGLDisplay(), 0);
    return {};
}

void OutputWindow::swap() {
    eglSwapBuffers(glfwGetEGLDisplay(), glfwGetEGLSurface(state_->window.get()));
}

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

} // namespace tidemark::window
