// The overlay over a window's picture: a Model goes in, events that are meant for a panel are kept, Commands
// come out. Hidden it does nothing; Dear ImGui, which draws it, is loaded when it is shown first.
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
    /// From now on it shows that; a model of nothing hides it. A context of the window is current, as it is
    /// whenever the others are called. Fails where the plug-in cannot be loaded, once: then it stays hidden.
    Result<void> show(Model model, const Surface& surface);

    bool visible() const { return visible_; }
    /// Whether the event is the overlay's: nobody else should learn of it.
    bool take(const platform::InputEvent& event);
    /// Into the window's own framebuffer, over what is there.
    void draw();
    /// It would look otherwise if it were drawn again.
    bool wants_frame() const { return visible_ && frames_wanted_ > 0; }

    /// What was asked for since the last call.
    Commands take_commands();

private:
    std::unique_ptr<Panels> panels_; ///< none before the plug-in is loaded
    Model::Panels open_{};
    bool visible_ = false;
    bool failed_ = false;
    int frames_wanted_ = 0;
};

} // namespace tidemark::live
