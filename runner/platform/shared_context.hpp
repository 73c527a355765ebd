// A context of its own beside a first one, a window's or a headless one, so that a thread can prepare what is
// shown later. Shares textures and programs with it.
#pragma once

#include "base/result.hpp"

namespace tidemark::platform {

/// Must not outlive the one that it was made beside. Current on one thread at a time.
/// Whether a context is made so that it tells when the driver was reset. Those that share are alike in that.
enum class ResetNotice { no, yes };

/// The value of EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY.
int reset_strategy(ResetNotice notice);

class SharedContext {
public:
    /// Beside `first`, which belongs to `display`; `surface`: of its window, null where it has none. All are
    /// EGL's; `notice` is that of `first`. ErrorCode::no_context, with the reason, when the driver gives
    /// none.
    static Result<SharedContext> create(void* display, void* first, void* surface, ResetNotice notice);
    SharedContext(SharedContext&& other) noexcept;
    SharedContext& operator=(SharedContext&& other) noexcept;
    /// Must be current on no other thread.
    ~SharedContext();

    /// On the calling thread. What is drawn into the window's own framebuffer is lost.
    Result<void> make_current();
    /// On the window's thread: its framebuffer is drawn into, Window::swap shows it.
    Result<void> make_current_in_window();
    /// Current nowhere, so that another thread may take it.
    void leave();

private:
    SharedContext() = default;
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
