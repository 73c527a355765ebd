// The interface of a place where a scene is shown, implemented by windows and by browser pages; and its
// clock.
//
// Seconds of a monotonic clock, from an arbitrary origin.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/gl_context.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"
#include "render/gl_textures.hpp"
#include "window/window.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::window {

inline double seconds_of(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(time.time_since_epoch()).count();
}

inline double now_seconds() {
    return seconds_of(std::chrono::steady_clock::now());
}

// A place where a scene is shown and controlled: a window, or browser pages. Takes pictures and overlay
// models; returns events and commands.

/// The facts about the picture on show, apart from its pixels.
struct ShownMoment {
    double seconds = 0; ///< iTime
    int frame = 0;
    bool reads_keyboard = false;  ///< the scene gets the keys
    bool follows_pointer = false; ///< the mouse moves without a button too
    bool reads_camera = false;    ///< the scene has an orbit camera
    double begun = 0;             ///< when drawing it began, by now_seconds
};

class Screen {
public:
    Screen() = default;
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;
    virtual ~Screen() = default;

    /// Creates a context that shares with the screen's own, which is current on the thread that made it.
    virtual Result<host::SharedContext> create_context() = 0;

    /// Returns the events since the last call, in order. Sleeps until there is one, `wake` is called or the
    /// seconds have passed; 0 never waits.
    virtual std::vector<host::InputEvent> wait(double seconds) = 0;
    /// Ends the current `wait`, or else the next one. May be called from any thread.
    virtual void wake() = 0;
    /// Returns whether the event belongs to a panel; it must not reach the scene then.
    virtual bool take(const host::InputEvent& event) = 0;
    /// Returns the panels' commands since the last call.
    virtual overlay::Commands take_commands() = 0;
    /// Returns whether this screen supports one of the window's keys.
    virtual bool has(host::Key key) const = 0;

    /// Returns the size of the picture, in pixels.
    virtual Extent extent() const = 0;
    /// Returns whether the screen is visible and ready for another picture.
    virtual bool is_watched() const = 0;
    /// Returns whether the panels must be shown again to be up to date.
    virtual bool wants_frame() const = 0;
    /// Shows a frame in two steps: `begin` the last drawn picture (null: none yet; `fresh`: it has changed),
    /// `finish` the panels over it. In between the caller may draw on the picture. Fails where the panels
    /// cannot be shown.
    virtual void begin(const gl::RenderTarget* picture, bool fresh) = 0;
    virtual Result<void> finish(overlay::Model model, const ShownMoment& moment) = 0;

    virtual void set_title(const std::string& title) = 0;
    virtual void set_clipboard(const std::string& text) = 0;
    /// Puts a PNG file's bytes into the clipboard as a picture. Fails where that is not possible, with the
    /// reason.
    virtual Result<void> set_clipboard_picture(std::string) {
        return fail(ErrorCode::usage, "only a window can copy a picture");
    }
    /// Makes the screen's own context current, after that of a scene is gone.
    virtual void enter() {}
    virtual void toggle_full_screen() = 0;
    virtual bool is_full_screen() const = 0;
    virtual std::optional<WindowPlace> place() const = 0;

    /// Registers `act`, which is called once, on any thread, if the screen is lost while the result lives.
    virtual std::shared_ptr<void> when_lost(std::function<void(std::string_view what)> act) = 0;
};

/// Opens a screen with that title.
using OpenScreen = std::function<Result<std::unique_ptr<Screen>>(const std::string& title)>;

} // namespace tidemark::window
