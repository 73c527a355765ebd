#include "base/file.hpp"
#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/serve/remote_screen.hpp"
#include "cli/view/viewer_options.hpp"
#include "serve/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace tidemark::cli {
namespace {

/// JPEG's limit of pixels along a side.
constexpr int k_largest_picture = 65500;
constexpr const char* k_token_variable = "TIDEMARK_TOKEN";

struct ServeOptions : ViewerOptions {
    std::string host = "127.0.0.1";
    int port = 0;
    std::string token_file;
    int quality = 85;
    std::string codec = "jpeg";
    bool once = false;
};

/// Returns the token. It cannot be a command line argument, because every user of the machine can read those.
Result<std::string> token_for(const ServeOptions& options) {
    std::string token;
    if (!options.token_file.empty())
        token = TRY(read_text_file(options.token_file));
    else if (const char* given = std::getenv(k_token_variable))
        token = given;
    else
        return serve::make_token();
    token.erase(token.find_last_not_of(" \r\n") + 1);
    TRY(serve::check_token(token));
    return token;
}

/// Prints the address on standard output. It contains the token, so it gives access and must be kept secret.
Result<void> announce(const RemoteScreen& screen) {
    if (!screen.is_loopback())
        say("warning: everybody who can reach this machine can read along: neither the pictures nor the "
            "token are encrypted. Without --host, `ssh -L` brings them to another machine in private");
    return put(screen.address() + "\n");
}

Result<int> serve_scene(const ServeOptions& options) {
    if (options.host.empty())
        return fail(ErrorCode::usage,
                    "--host '': give an address or a name of this machine, as in --host 127.0.0.1; 0.0.0.0 "
                    "is every address of it");
    auto frames = TRY(resolve(sized(options.frames, options.scene)));
    const Extent size = frames.state.extent;
    if (std::max(size.width, size.height) > k_largest_picture)
        return fail(ErrorCode::usage,
                    fmt::format("--size {}x{}: a picture that is sent has at most {} pixels "
                                "on a side",
                                size.width, size.height, k_largest_picture));
    const serve::ServerSettings server{options.host, uint16_t(options.port), TRY(token_for(options)), {}};
    auto settings = TRY(resolve(options, std::move(frames)));
    settings.plain = true; // knobs may change at any time
    settings.controls = true;
    settings.sounds = false;
    return show(std::move(settings), [&](const std::string&) -> Result<std::unique_ptr<Screen>> {
        auto screen =
            TRY(RemoteScreen::open({server, size, options.quality, options.codec == "vp8", options.once}));
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
    command.add_option("--host", options->host, "Where to listen: an address or a name of this machine")
        .type_name("HOST")
        .capture_default_str();
    command.add_option("--port", options->port, "Where to listen; 0: any that is free")
        .type_name("N")
        .check(number<int>("a whole number from 0 to 65535", 0, 65535))
        .capture_default_str();
    command
        .add_option("--token-file", options->token_file,
                    "Has the address's token, as TIDEMARK_TOKEN may; else one is made")
        .type_name("FILE");
    command.add_option("--quality", options->quality, "Of the pictures: JPEG's, from 1 to 100")
        .type_name("N")
        .check(number<int>("a whole number from 1 to 100", 1, 100))
        .capture_default_str();
    command
        .add_option("--codec", options->codec,
                    "jpeg, or vp8: films for browsers that show them, smaller where little moves")
        .type_name("NAME")
        .check(one_of({"jpeg", "vp8"}))
        .capture_default_str();
    command.add_flag("--once", options->once, "Ends when the last viewer has left");
    command.on_call([options, &chosen] { chosen = [options] { return serve_scene(*options); }; });
}

} // namespace tidemark::cli
