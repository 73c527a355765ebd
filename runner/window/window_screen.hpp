// The overlay over a window's picture. Input: a Model and events, of which it keeps those for panels. Output:
// Commands. While hidden it does nothing; the Dear ImGui plug-in is loaded when it is first shown.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"
#include "window/plugin/panels.hpp"
#include "window/screen.hpp"
#include "window/window.hpp"

#include <memory>

namespace tidemark::overlay {

class PanelLayer {
public:
    /// Shows a model from now on; an empty model hides the overlay. All calls need the window's context to be
    /// current. Fails once if the plug-in cannot be loaded; from then on the overlay stays hidden.
    Result<void> show(Model model, const Surface& surface);

    bool visible() const { return visible_; }
    /// Returns whether the event belongs to the overlay; it must not be handled further then.
    bool take(const host::InputEvent& event);
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

} // namespace tidemark::overlay

// A window as a Screen: the picture with the overlay's panels over it, and optionally a second window that
// shows the picture alone.

namespace tidemark::window {

class WindowScreen : public Screen {
public:
    struct Output {
        std::optional<int> monitor; ///< full screen on it; none: the size of the window
    };
    static Result<std::unique_ptr<Screen>> open(Extent size, const std::string& title,
                                                const window::WindowWishes& wishes,
                                                const std::optional<Output>& output);

    Result<host::SharedContext> create_context() override { return window_.create_context(); }
    std::vector<host::InputEvent> wait(double seconds) override;
    void wake() override { window::Window::wake(); }
    bool take(const host::InputEvent& event) override { return panels_.take(event); }
    overlay::Commands take_commands() override { return panels_.take_commands(); }
    bool has(host::Key) const override { return true; }

    Extent extent() const override { return window_.framebuffer_extent(); }
    bool is_watched() const override;
    bool wants_frame() const override { return panels_.wants_frame(); }
    void begin(const gl::RenderTarget* picture, bool fresh) override;
    Result<void> finish(overlay::Model model, const ShownMoment& moment) override;

    void set_title(const std::string& title) override { window_.set_title(title); }
    void set_clipboard(const std::string& text) override { window_.set_clipboard(text); }
    Result<void> set_clipboard_picture(std::string png) override;
    void enter() override { window_.make_current(); }
    void toggle_full_screen() override { window_.toggle_full_screen(); }
    bool is_full_screen() const override { return window_.is_full_screen(); }
    std::optional<window::WindowPlace> place() const override { return window_.place(); }
    std::shared_ptr<void> when_lost(std::function<void(std::string_view what)> act) override;

private:
    explicit WindowScreen(window::Window window) : window_(std::move(window)) {}
    void listen_to_output(std::vector<host::InputEvent>& events);
    void show_on_output(const gl::RenderTarget& picture);

    window::Window window_;                      ///< owns the context, so it is destroyed last
    std::optional<window::OutputWindow> output_; ///< none after the user has closed it
    overlay::PanelLayer panels_;
};

} // namespace tidemark::window
