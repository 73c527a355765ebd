// The overlay over a window's picture. Input: a Model and events, of which it keeps those for panels. Output:
// Commands. While hidden it does nothing; the Dear ImGui plug-in is loaded when it is first shown.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "live/command.hpp"
#include "live/model.hpp"
#include "live/plugin/panels.hpp"
#include "platform/input.hpp"

#include <memory>

namespace tidemark::live {

class Overlay {
public:
    /// Shows a model from now on; an empty model hides the overlay. All calls need the window's context to be
    /// current. Fails once if the plug-in cannot be loaded; from then on the overlay stays hidden.
    Result<void> show(Model model, const Surface& surface);

    bool visible() const { return visible_; }
    /// Returns whether the event belongs to the overlay; it must not be handled further then.
    bool take(const platform::InputEvent& event);
    /// Draws into the window's own framebuffer, over its contents.
    void draw();
    /// Returns whether the layout is not final yet, so that it must be drawn again.
    bool wants_frame() const { return visible_ && frames_wanted_ > 0; }

    /// Returns the commands since the last call.
    Commands take_commands();

private:
    std::unique_ptr<Panels> panels_; ///< null until the plug-in is loaded
    Model::Panels open_{};
    bool visible_ = false;
    bool failed_ = false;
    int frames_wanted_ = 0;
};

} // namespace tidemark::live
