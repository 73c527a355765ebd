// Browser pages as a Screen: pictures go out as JPEG or VP8, the input of the client in control comes in.
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
        int quality = 85;  ///< JPEG's, 1 to 100; VP8's is similar
        bool film = false; ///< VP8 instead of JPEG for clients that can show it
        bool once = false; ///< closes when the last client has left
    };

    /// Makes a headless context current and starts to listen. Fails as HeadlessContext and the plug-in do.
    static Result<std::unique_ptr<RemoteScreen>> open(Settings settings);
    ~RemoteScreen() override;

    /// Returns the URL for a browser, including the token.
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
    std::unique_ptr<serve::Film> film_; ///< used by the encoder
    std::unique_ptr<serve::PictureEncoder> encoder_;
    live::Commands commands_;
    const gl::RenderTarget* picture_ = nullptr; ///< of the scene, between `begin` and `finish`
    bool fresh_ = false;                        ///< it differs from the picture that was sent last
    std::optional<size_t> large_;               ///< the large picture that was sent last
    uint32_t pictures_ = 0;                     ///< number of pictures sent
    std::string told_;                          ///< the state that clients have
    bool was_asked_ = false;
    double woken_at_ = 0; ///< by now_seconds
};

} // namespace tidemark::cli
