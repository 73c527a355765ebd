#include "cli/view/window_screen.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "gl/blit.hpp"
#include "platform/window_loss.hpp"

#include <utility>
#include <variant>

namespace tidemark::cli {

Result<std::unique_ptr<Screen>> WindowScreen::open(Extent size, const std::string& title,
                                                   const platform::WindowWishes& wishes,
                                                   const std::optional<Output>& output) {
    auto window = TRY(platform::Window::create(size, title, wishes));
    std::unique_ptr<WindowScreen> screen(new WindowScreen(std::move(window)));
    if (output)
        screen->output_ =
            TRY(platform::OutputWindow::create(screen->window_, size, title + " output", output->monitor));
    return screen;
}

std::vector<platform::InputEvent> WindowScreen::wait(double seconds) {
    auto events = seconds > 0 ? window_.wait(seconds) : window_.poll();
    listen_to_output(events);
    return events;
}

/// Takes the events of the output window. Its keys act as in the first window; closing it closes only itself.
void WindowScreen::listen_to_output(std::vector<platform::InputEvent>& events) {
    if (!output_)
        return;
    for (platform::InputEvent event : output_->take_events()) {
        if (std::holds_alternative<platform::CloseRequested>(event))
            return output_.reset();
        if (std::holds_alternative<platform::FramebufferResized>(event))
            event = platform::RedrawNeeded{};
        events.push_back(event);
    }
}

void WindowScreen::show_on_output(const gl::RenderTarget& picture) {
    if (!output_ || output_->framebuffer_extent().pixels() == 0)
        return;
    const platform::KeepCurrent current;
    if (auto entered = output_->make_current(); !entered) {
        say(to_string(entered.error()));
        return output_.reset();
    }
    gl::blit_fitted(picture, output_->framebuffer_extent());
    output_->swap();
}

/// Returns false for a minimised window, which has no pixels on some systems.
bool WindowScreen::is_watched() const {
    return extent().width > 0 && extent().height > 0;
}

void WindowScreen::begin(const gl::RenderTarget* picture, bool) {
    if (!picture)
        return gl::clear_window();
    show_on_output(*picture);
    gl::blit_to_window(*picture, extent());
}

Result<void> WindowScreen::finish(live::Model model, const ShownMoment&) {
    auto shown = overlay_.show(std::move(model), {extent(), window_.content_scale()});
    overlay_.draw();
    window_.swap();
    return shown;
}

std::shared_ptr<void> WindowScreen::when_lost(std::function<void(std::string_view what)> act) {
    return std::make_shared<platform::WhenDisplayIsLost>(std::move(act));
}

} // namespace tidemark::cli
