// Browser pages as a Screen: pictures go out as JPEG, the input of the client in control comes in.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "cli/viewer_options.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/gl_context.hpp"
#include "render/frame_plan.hpp"
#include "web/audience.hpp"
#include "web/messages.hpp"
#include "web/page.hpp"
#include "web/plugin/server.hpp"
#include "web/request.hpp"
#include "window/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

using namespace host;
using namespace window;
using host::resolve;
using window::open_editor;
namespace {

web::SharedMessage text_message(std::string text) {
    return std::make_shared<web::Message>(web::Message{std::move(text)});
}

/// Returns a texture as RGBA bytes, whatever its format.
image::Image read_texture(unsigned texture, Extent extent) {
    image::Image picture(extent, 4, image::SampleType::u8);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.bytes.size()),
                      picture.bytes.data());
    return picture;
}

image::Image read_target(const gl::RenderTarget& target) {
    image::Image picture(target.extent(), 4, image::SampleType::u8);
    gl::read_pixels(target, GL_RGBA, GL_UNSIGNED_BYTE, picture.bytes);
    return picture;
}

class RemoteScreen : public Screen {
public:
    struct Settings {
        web::ServerSettings server;
        Extent extent;
        int quality = 85;  ///< JPEG's, 1 to 100
        bool once = false; ///< closes when the last client has left
    };

    /// Makes a headless context current and starts to listen. Fails as HeadlessContext and the plug-in do.
    static Result<std::unique_ptr<RemoteScreen>> open(Settings settings) {
        auto context = TRY(host::HeadlessContext::create());
        TRY(render::check_size(settings.extent));
        std::unique_ptr<RemoteScreen> screen(new RemoteScreen(std::move(settings), std::move(context)));
        TRY(screen->listen());
        return screen;
    }

    /// Stops the threads first: they send through members that are destroyed next.
    ~RemoteScreen() override {
        if (server_)
            server_->stop();
        encoder_.reset();
    }

    /// Returns the URL for a browser, including the token.
    std::string address() const {
        return fmt::format("http://{}/?token={}", server_->place(), settings_.server.token);
    }

    bool is_loopback() const { return server_->is_loopback(); }

    Result<host::SharedContext> create_context() override { return context_.create_context(); }

    std::vector<host::InputEvent> wait(double seconds) override {
        web::Inbox::Content content = inbox_.wait(seconds);
        woken_at_ = now_seconds();
        was_asked_ |= !content.commands.empty();
        commands_.insert(commands_.end(), std::make_move_iterator(content.commands.begin()),
                         std::make_move_iterator(content.commands.end()));
        return std::move(content.events);
    }

    void wake() override { inbox_.wake(); }
    bool take(const host::InputEvent&) override { return false; }

    overlay::Commands take_commands() override { return std::exchange(commands_, {}); }

    /// Returns whether the key works in a page. The others have no use there, or must not act on another
    /// machine.
    bool has(host::Key key) const override {
        using host::Key;
        switch (key) {
        case Key::space:
        case Key::left:
        case Key::right:
        case Key::home:
        case Key::r:
        case Key::c: return true;
        default: return key >= Key::digit_0 && key <= Key::digit_9;
        }
    }

    Extent extent() const override { return settings_.extent; }
    bool is_watched() const override { return encoder_->has_room() && audience_.is_waiting(); }
    bool wants_frame() const override { return was_asked_; }

    void begin(const gl::RenderTarget* picture, bool fresh) override {
        picture_ = picture;
        fresh_ |= fresh;
    }

    Result<void> finish(overlay::Model model, const ShownMoment& moment) override {
        was_asked_ = false;
        if (picture_ && (fresh_ || model.large != large_))
            send_picture(model, moment);
        std::string state = web::state_text(model, settings_.extent,
                                            {.keyboard = moment.reads_keyboard,
                                             .every_move = moment.follows_pointer,
                                             .camera = moment.reads_camera});
        if (state != told_)
            audience_.tell("state", text_message(state));
        told_ = std::move(state);
        return {};
    }

    void set_title(const std::string& title) override {
        audience_.tell("title", text_message(web::line_text("title", title)));
    }

    void set_clipboard(const std::string& text) override {
        audience_.tell_steering(text_message(web::line_text("clipboard", text)));
    }

    void toggle_full_screen() override {}
    bool is_full_screen() const override { return false; }
    std::optional<window::WindowPlace> place() const override { return std::nullopt; }
    std::shared_ptr<void> when_lost(std::function<void(std::string_view what)>) override { return nullptr; }

private:
    RemoteScreen(Settings settings, host::HeadlessContext context)
        : settings_(std::move(settings)), context_(std::move(context)),
          audience_({.send = [this](auto viewer, auto message) { server_->send(viewer, std::move(message)); },
                     .once = settings_.once},
                    inbox_) {}

    Result<void> listen() {
        const web::ServePlugIn& plug_in = *TRY(web::load_serve_plug_in());
        settings_.server.page = web::k_viewer_page;
        server_ = TRY(plug_in.open(settings_.server));
        encoder_ = std::make_unique<web::PictureEncoder>(web::PictureEncoder::Settings{
            .encode =
                [encode = plug_in.encode, quality = settings_.quality](const image::Image& picture) {
                    return encode(picture.extent, picture.bytes, quality);
                },
            .done = [this](web::NumberedPicture picture) { audience_.show(std::move(picture)); }});
        server_->start(audience_);
        return {};
    }

    void send_picture(const overlay::Model& model, const ShownMoment& moment) {
        // An unchanged picture is only read back, so its time counts from the start of this iteration.
        const double begun = std::exchange(fresh_, false) ? moment.begun : woken_at_;
        large_ = model.large;
        const overlay::PictureField* large = large_ ? &model.pictures[*large_] : nullptr;
        image::Image picture = large ? read_texture(large->texture, large->extent) : read_target(*picture_);
        web::PictureHead head{.number = ++pictures_, .seconds = moment.seconds, .frame = moment.frame};
        for (const overlay::PictureField& field : model.pictures)
            head.costs.push_back(field.milliseconds);
        head.draw_ms = (now_seconds() - begun) * 1000;
        encoder_->push({std::move(picture), std::move(head)});
    }

    Settings settings_;
    host::HeadlessContext context_;
    web::Inbox inbox_;
    web::Audience audience_;
    std::unique_ptr<web::Server> server_;
    std::unique_ptr<web::PictureEncoder> encoder_;
    overlay::Commands commands_;
    const gl::RenderTarget* picture_ = nullptr; ///< of the scene, between `begin` and `finish`
    bool fresh_ = false;                        ///< it differs from the picture that was sent last
    std::optional<size_t> large_;               ///< the large picture that was sent last
    uint32_t pictures_ = 0;                     ///< number of pictures sent
    std::string told_;                          ///< the state that clients have
    bool was_asked_ = false;
    double woken_at_ = 0; ///< by now_seconds
};

/// JPEG's limit of pixels along a side.
constexpr int k_largest_picture = 65500;
constexpr const char* k_token_variable = "TIDEMARK_TOKEN";

struct ServeOptions : ViewerOptions {
    std::string host = "127.0.0.1";
    int port = 0;
    std::string token_file;
    int quality = 85;
    bool once = false;
    std::vector<std::string> ancestors;
    std::vector<std::string> origins;
};

/// Checks each value of an option; the error names the option.
Result<void> check_each(std::string_view option, const std::vector<std::string>& values,
                        Result<void> (*check)(std::string_view)) {
    for (const std::string& value : values)
        if (auto good = check(value); !good)
            return fail(good.error().code, fmt::format("{}: {}", option, good.error().message));
    return {};
}

/// Returns the token. It cannot be a command line argument, because every user of the machine can read those.
Result<std::string> token_for(const ServeOptions& options) {
    std::string token;
    if (!options.token_file.empty())
        token = TRY(read_text_file(options.token_file));
    else if (const char* given = std::getenv(k_token_variable))
        token = given;
    else
        return web::make_token();
    token.erase(token.find_last_not_of(" \r\n") + 1);
    TRY(web::check_token(token));
    return token;
}

/// Prints the address on standard output. It contains the token, so it gives access and must be kept secret.
Result<void> announce(const RemoteScreen& screen) {
    if (!screen.is_loopback())
        say("warning: the connection is not encrypted: others on the network can read the pictures and the "
            "token. For a private connection leave out --host and use `ssh -L`");
    return put(screen.address() + "\n");
}

Result<int> serve_scene(ServeOptions options) {
    if (options.host.empty())
        return fail(ErrorCode::usage, "--host '': give an address or a name of this machine, as in --host "
                                      "127.0.0.1; 0.0.0.0 stands for all its addresses");
    const auto editor = TRY(open_editor(options));
    auto frames = TRY(resolve(sized(options.frames, options.scene)));
    const Extent size = frames.state.extent;
    if (std::max(size.width, size.height) > k_largest_picture)
        return fail(ErrorCode::usage,
                    fmt::format("--size {}x{}: pictures sent to a browser have at most {} pixels on a side",
                                size.width, size.height, k_largest_picture));
    TRY(check_each("--frame-ancestor", options.ancestors, web::check_ancestor));
    TRY(check_each("--allow-origin", options.origins, web::check_origin));
    const web::ServerSettings server{options.host, uint16_t(options.port), TRY(token_for(options)),
                                     {},           options.ancestors,      options.origins};
    auto settings = TRY(resolve(options, std::move(frames), editor));
    settings.plain = true; // knobs may change at any time
    settings.controls = true;
    settings.sounds = false;
    return show(std::move(settings), [&](const std::string&) -> Result<std::unique_ptr<Screen>> {
        auto screen = TRY(RemoteScreen::open({server, size, options.quality, options.once}));
        TRY(announce(*screen));
        return screen;
    });
}

} // namespace

void add_serve(Command app, Action& chosen) {
    auto options = std::make_shared<ServeOptions>();
    Command command =
        app.add_subcommand("serve", "Shows a scene in browsers, from a machine without a display");
    add_viewer_options(command, *options);
    command.add_option("--host", options->host, "Address to listen at: an address or a name of this machine")
        .type_name("HOST")
        .capture_default_str();
    command.add_option("--port", options->port, "Port to listen at; 0: any free port")
        .type_name("N")
        .check(number<int>("a whole number from 0 to 65535", 0, 65535))
        .capture_default_str();
    command
        .add_option("--token-file", options->token_file,
                    "File with the access token; without it TIDEMARK_TOKEN is used, else a random token")
        .type_name("FILE");
    command.add_option("--quality", options->quality, "JPEG quality, from 1 to 100")
        .type_name("N")
        .check(number<int>("a whole number from 1 to 100", 1, 100))
        .capture_default_str();
    command.add_flag("--once", options->once, "Ends when the last viewer disconnects");
    command
        .add_option("--frame-ancestor", options->ancestors,
                    "Lets pages of that origin, or of that scheme, frame the page, as in vscode-webview:")
        .type_name("ORIGIN")
        .repeatable();
    command
        .add_option("--allow-origin", options->origins,
                    "Origin of a forwarded address, as in https://name-8080.example.dev")
        .type_name("ORIGIN")
        .repeatable();
    command.on_call([options, &chosen] { chosen = [options] { return serve_scene(*options); }; });
}

} // namespace tidemark::cli
