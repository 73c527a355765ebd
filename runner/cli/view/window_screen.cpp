#include "cli/view/window_screen.hpp"

#include "platform/window_loss.hpp"

#include <utility>

namespace tidemark::cli {

std::vector<platform::InputEvent> WindowScreen::wait(double seconds) {
    return seconds > 0 ? window_.wait(seconds) : window_.poll();
}

/// Minimised windows have no pixels on some systems.
bool WindowScreen::is_watched() const {
    return extent().width > 0 && extent().height > 0;
}

void WindowScreen::begin(const gl::RenderTarget* picture, bool) {
    if (picture)
        gl::blit_to_window(*picture, extent());
    else
        gl::clear_window();
}

Result<void> WindowScreen::finish(live::Model model, const ShownMoment&) {
    auto shown = overlay_.show(std::move(model), {extent(), window_.content_scale()});
    overlay_.draw();
    window_.swap();
    return shown;
}

std::shared_ptr<void> WindowScreen::when_lost(std::function<void()> act) {
    return std::make_shared<platform::WhenDisplayIsLost>(std::move(act));
}

} // namespace tidemark::cli
