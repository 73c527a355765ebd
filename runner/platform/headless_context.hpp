// An OpenGL 4.5 core context with no window and no surface, made through EGL. In comes the name of a
// device, out goes a context that is current on the calling thread. Draws nothing and prints nothing.
#pragma once

#include "base/result.hpp"
#include "platform/device_choice.hpp"
#include "platform/shared_context.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::platform {

/// Whether the driver is asked to explain its complaints (GL_KHR_debug); costs time in every GL call.
enum class DebugContext { no, yes };

class HeadlessContext {
public:
    /// The name of the choice: "surfaceless", "device:N" (in EGL's order), "display" (the X or Wayland
    /// display), a name that stays (HeadlessDevice::lasting_names), or "auto", which tries them all
    /// (order_to_try). Fails with ErrorCode::usage on any other name and with ErrorCode::no_context, saying
    /// what was tried and why each failed, when there is none.
    static Result<HeadlessContext> create(const DeviceChoice& choice = {},
                                          DebugContext debug = DebugContext::no);
    HeadlessContext(HeadlessContext&&) noexcept;
    HeadlessContext& operator=(HeadlessContext&&) noexcept;
    ~HeadlessContext();

    /// Needed only where a process has more than one context.
    Result<void> make_current();
    /// Another one that knows the same textures, current nowhere.
    Result<SharedContext> create_context();
    /// The name that `create` takes for this very device; never "auto".
    const std::string& device() const;

private:
    struct State;
    explicit HeadlessContext(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

enum class DeviceKind { hardware, software, unknown };

/// One place where a context may be made.
struct HeadlessDevice {
    std::string name; ///< as `create` takes it
    DeviceKind kind = DeviceKind::unknown;
    std::string renderer;                     ///< GL_RENDERER; empty when there is no context
    std::string version;                      ///< GL_VERSION; empty when there is no context
    std::string reason;                       ///< why there is no context; empty when there is one
    std::vector<std::string> lasting_names{}; ///< `pci:…`, `uuid:…`, `cuda:N`; `create` takes these, too
};

/// Every place, in EGL's order, each tried by making a context. What was current stays current.
std::vector<HeadlessDevice> list_headless_devices();
/// Likewise, but for the first few; `seen` is called with each twice: with its name before it is tried, and
/// with what came of it.
void list_headless_devices(const std::function<void(const HeadlessDevice&, bool tried)>& seen,
                           size_t skipped);

} // namespace tidemark::platform
