// Pages of browsers as a Screen: pictures go out as JPEG or VP8, what the steering viewer does comes in.
#pragma once

#include "cli/view/screen.hpp"
#include "platform/headless_context.hpp"
#include "serve/audience.hpp"
#include "serve/inbox.hpp"
#include "serve/picture_encoder.hpp"
#include "serve/plugin/server.hpp"

#include <memory>
#include <optional>
#include <string>

namespace tidemark::cli {

class RemoteScreen : public Screen {
public:
    struct Settings {
        serve::ServerSettings server;
        Extent extent;
        int quality = 85;  ///< JPEG's; a film's is much the same
        bool film = false; ///< VP8 for whoever can show it, instead of JPEG
        bool once = false; ///< closed when the last viewer has left
    };

    /// Makes a headless context current, and listens. Fails as HeadlessContext and the plug-in do.
    static Result<std::unique_ptr<RemoteScreen>> open(Settings settings);
    ~RemoteScreen() override;

    /// Where a browser finds it, token included.
    std::string address() const;
    bool is_loopback() const { return server_->is_loopback(); }

    Result<platform::SharedContext> create_context() override { return context_.create_context(); }
    std::vector<platform::InputEvent> wait(double seconds) override;
    void wake() override { inbox_.wake(); }
    bool take(const platform::InputEvent&) override { return false; }
    live::Commands take_commands() override;
    bool has(platform::Key key) const override;

    Extent extent() const override { return settings_.extent; }
    bool is_watched() const override { return encoder_->has_room() && audience_.is_waiting(); }
    bool wants_frame() const override { return was_asked_; }
    void begin(const gl::RenderTarget* picture, bool fresh) override;
    Result<void> finish(live::Model model, const ShownMoment& moment) override;

    void set_title(const std::string& title) override;
    void set_clipboard(const std::string& text) override;
    void toggle_full_screen() override {}
    std::optional<platform::WindowPlace> place() const override { return std::nullopt; }
    std::shared_ptr<void> when_lost(std::function<void(std::string_view what)>) override { return nullptr; }

private:
    RemoteScreen(Settings settings, platform::HeadlessContext context);
    Result<void> listen();
    void send_picture(const live::Model& model, const ShownMoment& moment);

    Settings settings_;
    platform::HeadlessContext context_;
    serve::Inbox inbox_;
    serve::Audience audience_;
    std::unique_ptr<serve::Server> server_;
    std::unique_ptr<serve::Film> film_; ///< the encoder's
    std::unique_ptr<serve::PictureEncoder> encoder_;
    live::Commands commands_;
    const gl::RenderTarget* picture_ = nullptr; ///< of the scene, between `begin` and `finish`
    bool fresh_ = false;                        ///< it is not what was sent last
    std::optional<size_t> large_;               ///< what was sent last, as the model has it
    uint32_t pictures_ = 0;                     ///< that were sent
    std::string told_;                          ///< the state that viewers know
    bool was_asked_ = false;
    double woken_at_ = 0; ///< as now_seconds counts
};

} // namespace tidemark::cli
