// A context of its own beside a window's first one, so that a thread can prepare what the window shows later.
// Shares textures and programs with it.
#pragma once

#include "base/result.hpp"

namespace tidemark::platform {

/// Made by Window::create_context, and must not outlive the window. Current on one thread at a time.
class WindowContext {
public:
    WindowContext(WindowContext&& other) noexcept;
    WindowContext& operator=(WindowContext&& other) noexcept;
    /// Must be current on no other thread.
    ~WindowContext();

    /// On the calling thread. What is drawn into the window's own framebuffer is lost.
    Result<void> make_current();
    /// On the window's thread: its framebuffer is drawn into, Window::swap shows it.
    Result<void> make_current_in_window();
    /// Current nowhere, so that another thread may take it.
    void leave();

private:
    friend class Window;
    friend class OutputWindow;
    WindowContext() = default;
    Result<void> make_current_with(void* surface);

    void* display_ = nullptr; ///< EGL's, as are the others
    void* window_ = nullptr;
    void* context_ = nullptr; ///< null: moved from
};

/// What is current on this thread when it is made is current again when it goes.
class KeepCurrent {
public:
    KeepCurrent();
    KeepCurrent(const KeepCurrent&) = delete;
    KeepCurrent& operator=(const KeepCurrent&) = delete;
    ~KeepCurrent();

private:
    void* display_;
    void* context_;
    void* draw_;
    void* read_;
};

} // namespace tidemark::platform
