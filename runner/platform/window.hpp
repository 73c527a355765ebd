// A window with an OpenGL 4.5 core context. In comes a size and a title, out goes what people do to it,
// as InputEvents. Does not know what is drawn in it, nor when.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "platform/input.hpp"
#include "platform/shared_context.hpp"
#include "platform/window_wishes.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::platform {

/// One at a time in a process, on the main thread: the window system is started with it and ended with it.
class Window {
public:
    /// Opens it and makes its context current. `logical_size` is in pixels of an ordinary display; a dense
    /// one gives more (framebuffer_extent). Waits for vertical sync where the system has one, so a caller
    /// must not rely on `swap` to set its pace. ErrorCode::no_context, with the reason, when there is none.
    /// ErrorCode::usage for a place that no monitor has.
    static Result<Window> create(Extent logical_size, const std::string& title,
                                 const WindowWishes& wishes = {});
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    void make_current();
    /// Another context for the same window, current nowhere. All of them know each other's textures.
    Result<SharedContext> create_context();

    /// What happened since the last call, in order; never waits.
    std::vector<InputEvent> poll();
    /// The same, but sleeps until something happens, `wake` is called or `seconds` have passed. Infinity
    /// is allowed. May return early with nothing.
    std::vector<InputEvent> wait(double seconds);
    /// Ends the `wait` under way, or else the next one. Callable from every thread while a Window lives.
    static void wake();

    /// As of the last event returned.
    Extent framebuffer_extent() const;
    /// Pixels of this display for one of an ordinary display's: 2 on a dense one.
    double content_scale() const;
    /// Where it is; full screen: where it was.
    WindowPlace place() const;
    /// What other programs paste from now on, as long as this one runs.
    void set_clipboard(const std::string& text);
    /// Shows what has been drawn.
    void swap();
    void set_title(const std::string& title);
    /// On the monitor that holds most of the window; and back to where it was.
    void toggle_full_screen();

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace tidemark::platform
