// A second window next to a Window that shows only the picture, on a projector for example. One of the first
// window's contexts draws into it.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "platform/input.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::platform {

class Window;

class OutputWindow {
public:
    /// Opens it next to `first`, which must outlive it; main thread only. With a monitor (1 is the first;
    /// ErrorCode::usage if there are fewer) it is full screen, otherwise it has the given size. The current
    /// context stays current.
    static Result<OutputWindow> create(const Window& first, Extent logical_size, const std::string& title,
                                       std::optional<int> monitor);
    OutputWindow(OutputWindow&&) noexcept;
    OutputWindow& operator=(OutputWindow&&) noexcept;
    ~OutputWindow();

    /// Returns keys, RedrawNeeded, FramebufferResized and CloseRequested since the last call, as of the first
    /// window's last poll or wait.
    std::vector<InputEvent> take_events();
    Extent framebuffer_extent() const;

    /// Makes the current context, one of the first window's, draw into this window from now on.
    Result<void> make_current();
    /// Shows what the context has drawn; does not wait for vertical sync, since the first window does.
    void swap();

private:
    struct State;
    explicit OutputWindow(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace tidemark::platform
