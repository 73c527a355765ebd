// Where a scene is seen, and where people act on it: a window, or pages of browsers. Pictures and what lies
// over them go in, events and commands come out.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "gl/render_target.hpp"
#include "live/command.hpp"
#include "live/model.hpp"
#include "platform/input.hpp"
#include "platform/shared_context.hpp"
#include "platform/window.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// What the picture on show has beside its pixels.
struct ShownMoment {
    double seconds = 0; ///< iTime
    int frame = 0;
    bool reads_keyboard = false; ///< keys are the scene's
    double begun = 0;            ///< when drawing it was, as now_seconds counts
};

class Screen {
public:
    Screen() = default;
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;
    virtual ~Screen() = default;

    /// Beside the screen's own, which is current on the thread that made it.
    virtual Result<platform::SharedContext> create_context() = 0;

    /// What people did since the last call, in order. Sleeps until there is something, `wake` is called or
    /// the seconds have passed; 0 never waits.
    virtual std::vector<platform::InputEvent> wait(double seconds) = 0;
    /// Ends the `wait` under way, or else the next one. From any thread.
    virtual void wake() = 0;
    /// Whether the event is that of a panel: the scene should not learn of it.
    virtual bool take(const platform::InputEvent& event) = 0;
    /// What was asked for in panels since the last call.
    virtual live::Commands take_commands() = 0;
    /// Whether a key of the window's means something here.
    virtual bool has(platform::Key key) const = 0;

    /// Of the picture, in pixels.
    virtual Extent extent() const = 0;
    /// Somebody looks, and another picture would reach them.
    virtual bool is_watched() const = 0;
    /// The panels would look otherwise if they were shown again.
    virtual bool wants_frame() const = 0;
    /// In two steps: the picture as it was drawn last (null: none yet), `fresh` where it is another one than
    /// before; then, over what the caller draws on top of it, the panels. Fails where these cannot be shown.
    virtual void begin(const gl::RenderTarget* picture, bool fresh) = 0;
    virtual Result<void> finish(live::Model model, const ShownMoment& moment) = 0;

    virtual void set_title(const std::string& title) = 0;
    virtual void set_clipboard(const std::string& text) = 0;
    virtual void toggle_full_screen() = 0;
    virtual std::optional<platform::WindowPlace> place() const = 0;

    /// While the result lives `act` is called, once and on any thread, when the screen is lost.
    virtual std::shared_ptr<void> when_lost(std::function<void(std::string_view what)> act) = 0;
};

/// Opens one that has that title.
using OpenScreen = std::function<Result<std::unique_ptr<Screen>>(const std::string& title)>;

} // namespace tidemark::cli
