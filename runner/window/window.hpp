// Windows with OpenGL contexts: the window, a second one for output, its place, and the loss of the display.
//
// The requested place of a window, as values.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/gl_context.hpp"
#include "host/input_events.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::window {

/// A window's place on the screen: its upper left corner in the window system's coordinates, its size in
/// pixels of an ordinary display.
struct WindowPlace {
    int x = 0;
    int y = 0;
    Extent size;
};

/// A point, from the upper left corner of the screen or of a monitor, in the window system's coordinates.
struct ScreenPoint {
    int x = 0;
    int y = 0;
};

/// Requested place and stacking of a window. Not every system lets a program choose the place.
struct WindowWishes {
    /// place of the last window of its kind, used if a monitor still shows it
    std::optional<WindowPlace> left_at{};
    std::optional<int> monitor{};          ///< 1 is the first; the window is centred on it
    std::optional<ScreenPoint> position{}; ///< the upper left corner, on `monitor` if that is set
    bool on_top = false;                   ///< stays above other windows
    bool es = false;                       ///< with OpenGL ES 3.1 or later
};

// A window with an OpenGL 4.5 core context, or with one of OpenGL ES. Takes a size and a title, returns the
// user's input as InputEvents. Draws nothing itself.

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
    Result<host::SharedContext> create_context();

    /// Returns the events since the last call, in order; never waits.
    std::vector<host::InputEvent> poll();
    /// The same, but sleeps until an event comes, `wake` is called or `seconds` have passed. Infinity is
    /// allowed. May return early without events.
    std::vector<host::InputEvent> wait(double seconds);
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
    bool is_full_screen() const;

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

// A second window next to a Window that shows only the picture, on a projector for example. One of the first
// window's contexts draws into it.

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
    std::vector<host::InputEvent> take_events();
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

// Handles the loss of the window: the X server dies, the connection breaks, or another program destroys the
// window.

/// While this object exists, `act` is called once when the window is lost, on the thread that notices, with a
/// description; the process ends when it returns. There must be a Window. On Wayland the window is asked to
/// close instead.
class WhenDisplayIsLost {
public:
    explicit WhenDisplayIsLost(std::function<void(std::string_view what)> act);
    ~WhenDisplayIsLost();
    WhenDisplayIsLost(const WhenDisplayIsLost&) = delete;
    WhenDisplayIsLost& operator=(const WhenDisplayIsLost&) = delete;
};

} // namespace tidemark::window
