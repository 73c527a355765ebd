#include "platform/window.hpp"

#include "base/printable.hpp"
#include "platform/window_keys.hpp"

#include <EGL/egl.h>
#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <span>
#include <utility>

namespace tidemark::platform {
namespace {

/// Ends GLFW when it goes.
struct Library {
    Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { glfwTerminate(); }
};

/// In GLFW's screen coordinates, origin at the top left.
struct Rectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

int common_area(const Rectangle& a, const Rectangle& b) {
    const int width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const int height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return std::max(width, 0) * std::max(height, 0);
}

Rectangle place_of(GLFWwindow* window) {
    Rectangle place;
    glfwGetWindowPos(window, &place.x, &place.y);
    glfwGetWindowSize(window, &place.width, &place.height);
    return place;
}

struct Monitor {
    GLFWmonitor* handle = nullptr; ///< null: there is none
    Rectangle place;
    int refresh_rate = 0;
};

Monitor monitor_under(const Rectangle& window) {
    int count = 0;
    GLFWmonitor** handles = glfwGetMonitors(&count);
    Monitor best;
    int best_area = -1;
    for (GLFWmonitor* handle : std::span(handles, size_t(count))) {
        const GLFWvidmode* mode = glfwGetVideoMode(handle);
        if (!mode)
            continue;
        Monitor monitor{handle, {0, 0, mode->width, mode->height}, mode->refreshRate};
        glfwGetMonitorPos(handle, &monitor.place.x, &monitor.place.y);
        const int area = common_area(window, monitor.place);
        if (area > best_area)
            best = monitor;
        best_area = std::max(area, best_area);
    }
    return best;
}

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW does not say why";
}

tl::unexpected<Error> cannot_open(std::string_view why) {
    return fail(ErrorCode::no_context,
                fmt::format("cannot open a window: {}; `tidemark capture` draws without one", why));
}

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

/// GLFW has no question for it, but this call fails on a library that was not started.
bool library_runs() {
    glfwGetError(nullptr);
    glfwGetTime();
    return glfwGetError(nullptr) != GLFW_NOT_INITIALIZED;
}

/// Hidden, where it is to be moved first.
GLFWwindow* open_window(Extent size, const char* title, bool visible) {
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    // It starts faster than GLX, it is the driver that headless drawing uses, and it has contexts apart from
    // windows.
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "tidemark");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "tidemark");
    return glfwCreateWindow(size.width, size.height, title, nullptr, nullptr);
}

/// A screen that was there last time may be gone.
void show_at(GLFWwindow* window, const WindowPlace& corner) {
    Rectangle place = place_of(window);
    place.x = corner.x;
    place.y = corner.y;
    if (const Monitor monitor = monitor_under(place); monitor.handle && common_area(place, monitor.place) > 0)
        glfwSetWindowPos(window, corner.x, corner.y);
    glfwShowWindow(window);
}

Button button_from_glfw(int button) {
    return button == GLFW_MOUSE_BUTTON_LEFT    ? Button::left
           : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::right
                                               : Button::middle;
}

} // namespace

/// Stays where it is when the Window moves, so that GLFW's user pointer may point to it.
struct Window::State {
    Library library;
    std::unique_ptr<GLFWwindow, DestroyWindow> window;
    std::vector<InputEvent> events{};
    Extent framebuffer{};
    Extent screen{};     ///< the same area in GLFW's screen coordinates
    double cursor_x = 0; ///< in screen coordinates, origin at the top left
    double cursor_y = 0;
    Rectangle before_full_screen{};

    /// The sizes as of the events delivered so far: GLFW's own answers may be ahead of them.
    PointerPosition pointer() const {
        const double scale_x = screen.width > 0 ? double(framebuffer.width) / screen.width : 1.0;
        const double scale_y = screen.height > 0 ? double(framebuffer.height) / screen.height : 1.0;
        return {cursor_x * scale_x, framebuffer.height - cursor_y * scale_y};
    }
    std::vector<InputEvent> take() { return std::exchange(events, {}); }

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
    void listen();
    void listen_to_people();
};

void Window::State::listen() {
    GLFWwindow* handle = window.get();
    glfwSetWindowUserPointer(handle, this);
    glfwGetFramebufferSize(handle, &framebuffer.width, &framebuffer.height);
    glfwGetWindowSize(handle, &screen.width, &screen.height);
    glfwGetCursorPos(handle, &cursor_x, &cursor_y);
    glfwSetWindowSizeCallback(handle, [](GLFWwindow* source, int width, int height) {
        of(source).screen = {width, height};
    });
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* source, int width, int height) {
        State& state = of(source);
        state.framebuffer = {width, height};
        state.events.push_back(FramebufferResized{state.framebuffer});
    });
    glfwSetWindowRefreshCallback(handle,
                                 [](GLFWwindow* source) { of(source).events.push_back(RedrawNeeded{}); });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* source) {
        glfwSetWindowShouldClose(source, GLFW_FALSE);
        of(source).events.push_back(CloseRequested{});
    });
    glfwSetWindowFocusCallback(handle, [](GLFWwindow* source, int focused) {
        if (!focused)
            of(source).events.push_back(FocusLost{});
    });
    listen_to_people();
}

void Window::State::listen_to_people() {
    GLFWwindow* handle = window.get();
    glfwSetCursorPosCallback(handle, [](GLFWwindow* source, double x, double y) {
        State& state = of(source);
        state.cursor_x = x;
        state.cursor_y = y;
        state.events.push_back(PointerMoved{state.pointer()});
    });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* source, int button, int action, int) {
        State& state = of(source);
        if (button > GLFW_MOUSE_BUTTON_MIDDLE)
            return;
        if (action == GLFW_PRESS)
            state.events.push_back(ButtonPressed{button_from_glfw(button), state.pointer()});
        else
            state.events.push_back(ButtonReleased{button_from_glfw(button), state.pointer()});
    });
    glfwSetScrollCallback(handle, [](GLFWwindow* source, double right, double up) {
        of(source).events.push_back(WheelTurned{right, up});
    });
    glfwSetCharCallback(handle, [](GLFWwindow* source, unsigned character) {
        of(source).events.push_back(TextTyped{char32_t(character)});
    });
    glfwSetKeyCallback(handle, [](GLFWwindow* source, int glfw_key, int scancode, int action, int) {
        const Key key = key_from_glfw(glfw_key, glfwGetKeyName(glfw_key, scancode));
        if (key == Key::unknown)
            return;
        if (action == GLFW_RELEASE)
            of(source).events.push_back(KeyReleased{key});
        else
            of(source).events.push_back(KeyPressed{key, action == GLFW_REPEAT});
    });
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::create(Extent logical_size, const std::string& title,
                              const std::optional<WindowPlace>& corner) {
    assert(logical_size.width > 0 && logical_size.height > 0);
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
        return cannot_open("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
    if (library_runs())
        return cannot_open("this process has one already");
    if (!glfwInit())
        return cannot_open(last_glfw_error());
    auto state = std::make_unique<State>();
    state->window.reset(open_window(logical_size, printable_line(title).c_str(), !corner));
    if (!state->window)
        return cannot_open(last_glfw_error());
    if (corner)
        show_at(state->window.get(), *corner);
    glfwMakeContextCurrent(state->window.get());
    glfwSwapInterval(1);
    state->listen();
    return Window(std::move(state));
}

void Window::make_current() {
    glfwMakeContextCurrent(state_->window.get());
}

Result<SharedContext> Window::create_context() {
    GLFWwindow* window = state_->window.get();
    return SharedContext::create(glfwGetEGLDisplay(), glfwGetEGLContext(window), glfwGetEGLSurface(window));
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
    const bool full = glfwGetWindowMonitor(state_->window.get()) != nullptr;
    const Rectangle place = full ? state_->before_full_screen : place_of(state_->window.get());
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
    glfwSetWindowTitle(state_->window.get(), printable_line(title).c_str());
}

void Window::toggle_full_screen() {
    GLFWwindow* window = state_->window.get();
    if (glfwGetWindowMonitor(window)) {
        const Rectangle& back = state_->before_full_screen;
        glfwSetWindowMonitor(window, nullptr, back.x, back.y, back.width, back.height, GLFW_DONT_CARE);
        return;
    }
    state_->before_full_screen = place_of(window);
    const Monitor monitor = monitor_under(state_->before_full_screen);
    if (monitor.handle)
        glfwSetWindowMonitor(window, monitor.handle, 0, 0, monitor.place.width, monitor.place.height,
                             monitor.refresh_rate);
}

} // namespace tidemark::platform
