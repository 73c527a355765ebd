#include "window/window_screen.hpp"

#include "base/dynamic_library.hpp"
#include "base/error.hpp"
#include "host/console.hpp"
#include "render/gl_textures.hpp"
#include "window/window.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace tidemark::live {
namespace {

/// Frames until the layout is final: sizes and hit tests lag one or two frames after a change.
constexpr int k_frames_to_settle = 3;

Result<std::unique_ptr<Panels>> load_panels() {
    const PlugIn plug_in{"tidemark_overlay.so", "overlay plug-in", "the overlay",
                         "Dear ImGui 1.86",     k_panels_entry,    k_panels_version};
    const auto* table = TRY(load_plug_in<PanelsPlugIn>(plug_in));
    return table->create();
}

/// Returns whether all open panels are short messages: the last one of the list.
bool only_messages(const Model::Panels& open) {
    return std::none_of(open.begin(), open.end() - 1, [](bool panel) { return panel; });
}

} // namespace

Result<void> PanelLayer::show(Model model, const Surface& surface) {
    const Model::Panels open = model.panels();
    const bool visible = open != Model::Panels{} && !failed_;
    if (std::exchange(open_, open) != open)
        frames_wanted_ = k_frames_to_settle;
    if (!visible && visible_)
        panels_->release_all();
    visible_ = false;
    if (!visible)
        return {};
    if (!panels_) {
        auto loaded = load_panels();
        if (!loaded && only_messages(open))
            return {}; // nothing that the user has opened
        failed_ = true;
        panels_ = TRY(std::move(loaded));
        failed_ = false;
    }
    visible_ = true;
    panels_->show(std::move(model), surface);
    return {};
}

bool PanelLayer::take(const platform::InputEvent& event) {
    if (!visible_)
        return false;
    frames_wanted_ = k_frames_to_settle;
    return panels_->take(event);
}

void PanelLayer::draw() {
    if (!visible_)
        return;
    panels_->draw();
    --frames_wanted_;
}

Commands PanelLayer::take_commands() {
    return panels_ ? panels_->take_commands() : Commands{};
}

} // namespace tidemark::live

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
    auto shown = panels_.show(std::move(model), {extent(), window_.content_scale()});
    panels_.draw();
    window_.swap();
    return shown;
}

std::shared_ptr<void> WindowScreen::when_lost(std::function<void(std::string_view what)> act) {
    return std::make_shared<platform::WhenDisplayIsLost>(std::move(act));
}

} // namespace tidemark::cli
