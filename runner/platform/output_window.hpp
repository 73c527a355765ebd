// A second window beside a Window, for a picture alone: on a projector, say. What is drawn in it is drawn by
// a context of the other one's.
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
    /// Beside `first`, which must outlive it, on the main thread. On a monitor (1 is the first;
    /// ErrorCode::usage where there are not so many) it is full screen, else of that size. The current
    /// context stays so.
    static Result<OutputWindow> create(const Window& first, Extent logical_size, const std::string& title,
                                       std::optional<int> monitor);
    OutputWindow(OutputWindow&&) noexcept;
    OutputWindow& operator=(OutputWindow&&) noexcept;
    ~OutputWindow();

    /// Keys, RedrawNeeded, FramebufferResized and CloseRequested since the last call, as of the last events
    /// that the first window took.
    std::vector<InputEvent> take_events();
    Extent framebuffer_extent() const;

    /// What is drawn from now on by the context that is current, one of the first window's, is for this one.
    Result<void> make_current();
    /// Shows what has been drawn by it, and does not wait for the screen: the first window does.
    void swap();

private:
    struct State;
    explicit OutputWindow(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace tidemark::platform
