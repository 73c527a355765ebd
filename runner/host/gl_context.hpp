// OpenGL contexts through EGL: headless ones, and second ones that share textures.
//
// A second OpenGL context that shares textures and programs with a first one, a window's or a headless one,
// so that a thread can prepare what is shown later.
#pragma once

#include "base/error.hpp"
#include "host/devices.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::host {

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

// Makes an OpenGL 4.5 core context, or one of OpenGL ES, with no window and no surface, through EGL. Takes
// the name of a device; the context is current on the calling thread. Draws nothing and prints nothing.

/// Makes llvmpipe compile for texts that are drawn a few times in small pictures: without LLVM's
/// optimisations it draws the same bytes, and compiles faster, a large text in seconds instead of minutes. It
/// does not mix such code with other code in its cache. An environment with GALLIVM_PERF decides itself. Call
/// it before the first context.
void compile_for_few_drawings();

/// Whether the driver reports explanations of errors (GL_KHR_debug); costs time in every GL call.
enum class DebugContext { no, yes };

class HeadlessContext {
public:
    /// The choice's name is "surfaceless", "device:N" (in EGL's order), "display" (the X or Wayland display),
    /// a permanent name (HeadlessDevice::lasting_names), a driver of Mesa (mesa_drivers), or "auto", which
    /// tries the places (order_to_try). A name with_es makes a context of OpenGL ES 3.1 or later (gl::is_es).
    /// Fails with ErrorCode::usage on any other name; with ErrorCode::no_context, and the reason for each
    /// place tried, if there is none.
    static Result<HeadlessContext> create(const DeviceChoice& choice = {},
                                          DebugContext debug = DebugContext::no);
    HeadlessContext(HeadlessContext&&) noexcept;
    HeadlessContext& operator=(HeadlessContext&&) noexcept;
    ~HeadlessContext();

    /// Needed only if a process has several contexts.
    Result<void> make_current();
    /// Makes another context that shares textures; it is not current on any thread.
    Result<SharedContext> create_context();
    /// Returns the name with which `create` selects this very device; never "auto".
    const std::string& device() const;

private:
    struct State;
    explicit HeadlessContext(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

enum class DeviceKind { hardware, software, unknown };

/// A place where a context may be made.
struct HeadlessDevice {
    std::string name; ///< a name for `create`
    DeviceKind kind = DeviceKind::unknown;
    std::string renderer;                     ///< GL_RENDERER; empty if there is no context
    std::string version;                      ///< GL_VERSION; empty if there is no context
    std::string reason;                       ///< why there is no context; empty if there is one
    std::vector<std::string> lasting_names{}; ///< `pci:…`, `uuid:…`, `cuda:N`: names for `create` too
    std::string es_version{}; ///< GL_VERSION of a context with OpenGL ES; empty if there is none
};

/// Returns all names for `create` on this machine, from "auto" to Mesa's drivers. Starts no driver.
std::vector<std::string> device_names();

/// Lists every place but the first `skipped`, in EGL's order, after making a context there. Calls `seen`
/// twice for each: with its name before the try, and with the result after it. The current context stays
/// current.
void list_headless_devices(const std::function<void(const HeadlessDevice&, bool tried)>& seen,
                           size_t skipped);

/// Returns names for `create` of Mesa's drivers that draw on the CPU, such as "mesa:zink". A process can use
/// one driver of Mesa only: that of its first context.
std::vector<std::string> mesa_drivers();
bool is_mesa_driver(std::string_view name);
/// Returns a driver of that list, after making a context with it. Call it in a process without one.
HeadlessDevice describe_mesa_driver(const std::string& name);

} // namespace tidemark::host
