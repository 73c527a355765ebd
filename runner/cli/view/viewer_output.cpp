// The second window: the picture on show, without what lies over it in the first one.
#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/view/viewer.hpp"
#include "gl/blit.hpp"

#include <variant>

namespace tidemark::cli {

Result<void> Viewer::open_output(const std::string& title) {
    output_ = TRY(platform::OutputWindow::create(window_, settings_.frames.state.extent, title,
                                                 settings_.output->monitor));
    return {};
}

/// Keys are those of the first window; what is closed here is this one alone.
void Viewer::listen_to_output() {
    if (!output_)
        return;
    for (const platform::InputEvent& event : output_->take_events()) {
        if (const auto* pressed = std::get_if<platform::KeyPressed>(&event))
            handle(*pressed);
        else if (const auto* released = std::get_if<platform::KeyReleased>(&event))
            handle(*released);
        else if (std::holds_alternative<platform::CloseRequested>(event))
            return output_.reset();
        else
            stale_overlay_ = true;
    }
}

void Viewer::show_on_output(const gl::RenderTarget& picture) {
    if (!output_ || output_->framebuffer_extent().pixels() == 0)
        return;
    const platform::KeepCurrent current;
    if (auto entered = stage_->enter(*output_); !entered) {
        say(to_string(entered.error()));
        return output_.reset();
    }
    gl::blit_fitted(picture, output_->framebuffer_extent());
    output_->swap();
}

} // namespace tidemark::cli
