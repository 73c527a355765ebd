#include "platform/output_window.hpp"

#include "base/printable.hpp"
#include "base/try.hpp"
#include "platform/glfw_window.hpp"
#include "platform/monitors.hpp"
#include "platform/window_keys.hpp"

#include <EGL/egl.h>
#define GLFW_EXPOSE_NATIVE_EGL
#include <GLFW/glfw3.h>
#include <GLFW/glfw3native.h>
#include <fmt/format.h>

#include <utility>

namespace tidemark::platform {

/// Keeps its address when the OutputWindow moves, since GLFW's user pointer points to it.
struct OutputWindow::State {
    GlfwWindow window;
    std::vector<InputEvent> events{};
    Extent framebuffer{};

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
    void listen();
};

void OutputWindow::State::listen() {
    GLFWwindow* handle = window.get();
    glfwSetWindowUserPointer(handle, this);
    glfwGetFramebufferSize(handle, &framebuffer.width, &framebuffer.height);
    glfwSetFramebufferSizeCallback(handle, [](GLFWwindow* source, int width, int height) {
        State& state = of(source);
        state.framebuffer = {width, height};
        state.events.emplace_back(FramebufferResized{state.framebuffer});
    });
    glfwSetWindowRefreshCallback(handle,
                                 [](GLFWwindow* source) { of(source).events.emplace_back(RedrawNeeded{}); });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* source) {
        glfwSetWindowShouldClose(source, GLFW_FALSE);
        of(source).events.emplace_back(CloseRequested{});
    });
    glfwSetKeyCallback(handle, [](GLFWwindow* source, int key, int scancode, int action, int) {
        if (const auto event = key_event(key, scancode, action))
            of(source).events.push_back(*event);
    });
}

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
    hint_window();
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

} // namespace tidemark::platform
