// A second OpenGL context that shares textures and programs with a first one, a window's or a headless one,
// so that a thread can prepare what is shown later.
#pragma once

#include "base/result.hpp"

namespace tidemark::platform {

/// Whether a context reports that the driver was reset. Contexts that share must be alike in that.
enum class ResetNotice { no, yes };

/// The value of EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY.
int reset_strategy(ResetNotice notice);

/// A context that shares with another one, which must outlive it. Current on one thread at a time.
class SharedContext {
public:
    /// Makes a context that shares with `first`, a context of `display`; `surface` is its window's, null
    /// without a window. All are EGL's; `notice` is that of `first`. ErrorCode::no_context, with the reason,
    /// if the driver makes none.
    static Result<SharedContext> create(void* display, void* first, void* surface, ResetNotice notice);
    SharedContext(SharedContext&& other) noexcept;
    SharedContext& operator=(SharedContext&& other) noexcept;
    /// Must not be current on another thread.
    ~SharedContext();

    /// Makes it current on the calling thread, without a surface: drawing into the default framebuffer is
    /// lost.
    Result<void> make_current();
    /// Makes it current on the window's thread and draws into the window's framebuffer, which Window::swap
    /// shows.
    Result<void> make_current_in_window();
    /// Releases it, so that another thread may make it current.
    void leave();

private:
    SharedContext() = default;
    Result<void> make_current_with(void* surface);

    void* display_ = nullptr; ///< an EGL handle, like the next two
    void* window_ = nullptr;
    void* context_ = nullptr; ///< null: moved from
};

/// Restores, when destroyed, the context and surfaces that were current on this thread when it was made.
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
