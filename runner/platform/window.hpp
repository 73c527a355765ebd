// A window with an OpenGL 4.5 core context. Takes a size and a title, returns the user's input as
// InputEvents. Draws nothing itself.
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

/// One at a time in a process, on the main thread: it starts and ends the window system.
class Window {
public:
    /// Opens it and makes its context current. `logical_size` is in pixels of an ordinary display; a dense
    /// one has more (framebuffer_extent). Vertical sync is used if the system has it, so do not rely on
    /// `swap` to set the pace. ErrorCode::no_context, with the reason, if there is none; ErrorCode::usage for
    /// a place that no monitor shows.
    static Result<Window> create(Extent logical_size, const std::string& title,
                                 const WindowWishes& wishes = {});
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    void make_current();
    /// Makes another context for the same window, not current on any thread. All of them share textures.
    Result<SharedContext> create_context();

    /// Returns the events since the last call, in order; never waits.
    std::vector<InputEvent> poll();
    /// The same, but sleeps until an event comes, `wake` is called or `seconds` have passed. Infinity is
    /// allowed. May return early without events.
    std::vector<InputEvent> wait(double seconds);
    /// Ends the current `wait`, or else the next one. May be called from any thread while a Window exists.
    static void wake();

    /// Size as of the last event returned.
    Extent framebuffer_extent() const;
    /// Returns pixels of this display per pixel of an ordinary one: 2 on a dense one.
    double content_scale() const;
    /// Returns its place; in full screen, its place before.
    WindowPlace place() const;
    /// Sets the clipboard; other programs can paste the text while this one runs.
    void set_clipboard(const std::string& text);
    /// Shows what has been drawn.
    void swap();
    void set_title(const std::string& title);
    /// Fills the monitor that shows most of the window, or returns to the place before.
    void toggle_full_screen();

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace tidemark::platform
