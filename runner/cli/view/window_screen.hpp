// A window as a Screen: the picture with the overlay's panels over it, and optionally a second window that
// shows the picture alone.
#pragma once

#include "cli/view/screen.hpp"
#include "live/overlay.hpp"
#include "platform/output_window.hpp"
#include "platform/window.hpp"

namespace tidemark::cli {

class WindowScreen : public Screen {
public:
    struct Output {
        std::optional<int> monitor; ///< full screen on it; none: the size of the window
    };
    static Result<std::unique_ptr<Screen>> open(Extent size, const std::string& title,
                                                const platform::WindowWishes& wishes,
                                                const std::optional<Output>& output);

    Result<platform::SharedContext> create_context() override { return window_.create_context(); }
    std::vector<platform::InputEvent> wait(double seconds) override;
    void wake() override { platform::Window::wake(); }
    bool take(const platform::InputEvent& event) override { return overlay_.take(event); }
    live::Commands take_commands() override { return overlay_.take_commands(); }
    bool has(platform::Key) const override { return true; }

    Extent extent() const override { return window_.framebuffer_extent(); }
    bool is_watched() const override;
    bool wants_frame() const override { return overlay_.wants_frame(); }
    void begin(const gl::RenderTarget* picture, bool fresh) override;
    Result<void> finish(live::Model model, const ShownMoment& moment) override;

    void set_title(const std::string& title) override { window_.set_title(title); }
    void set_clipboard(const std::string& text) override { window_.set_clipboard(text); }
    void toggle_full_screen() override { window_.toggle_full_screen(); }
    std::optional<platform::WindowPlace> place() const override { return window_.place(); }
    std::shared_ptr<void> when_lost(std::function<void(std::string_view what)> act) override;

private:
    explicit WindowScreen(platform::Window window) : window_(std::move(window)) {}
    void listen_to_output(std::vector<platform::InputEvent>& events);
    void show_on_output(const gl::RenderTarget& picture);

    platform::Window window_;                      ///< owns the context, so it is destroyed last
    std::optional<platform::OutputWindow> output_; ///< none after the user has closed it
    live::Overlay overlay_;
};

} // namespace tidemark::cli
