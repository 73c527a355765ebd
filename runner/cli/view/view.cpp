#include "base/try.hpp"
#include "cli/commands.hpp"
#include "cli/view/viewer_options.hpp"
#include "cli/view/window_screen.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tidemark::cli {
namespace {

/// X11 counts the pixels of a window in 16 bits, half of them below zero; beyond that it takes another size.
constexpr int k_largest_window = 32767;

struct ViewOptions : ViewerOptions {
    bool plain = false;
    bool fresh = false;
};

/// How the last window was left, less what is typed now.
std::optional<Remembered> left_before(const ViewOptions& options, FrameSequence& frames) {
    auto state = recall(options.scene.path);
    if (!state)
        return state;
    if (state->place && !options.frames.size)
        frames.state.extent = state->place->size;
    if (state->moment && options.frames.camera)
        state->moment->sequence.state.camera = frames.state.camera;
    if (state->moment)
        erase_named(options.scene.sets, state->moment->sequence.state.knobs);
    return state;
}

Result<int> view(const ViewOptions& options) {
    auto frames = TRY(resolve(options.frames));
    const bool remembers = !options.by_frames();
    auto left = remembers && !options.fresh ? left_before(options, frames) : std::nullopt;
    const Extent size = frames.state.extent;
    if (std::max(size.width, size.height) > k_largest_window)
        return fail(ErrorCode::usage, fmt::format("--size {}x{}: a window has at most {} pixels on a side",
                                                  size.width, size.height, k_largest_window));
    auto settings = TRY(resolve(options, std::move(frames)));
    settings.plain = options.plain;
    settings.remembers = remembers;
    settings.left = std::move(left);
    const auto corner = settings.left ? settings.left->place : std::nullopt;
    return show(std::move(settings), [&](const std::string& title) {
        return platform::Window::create(size, title, corner)
            .map([](platform::Window window) -> std::unique_ptr<Screen> {
                return std::make_unique<WindowScreen>(std::move(window));
            });
    });
}

} // namespace

void add_view(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command =
        app.add_subcommand("view", "Opens a window, reloads the scene on save; press H in it for the keys");
    add_viewer_options(*command, *options);
    command->add_flag("--plain", options->plain,
                      "Stays with the scene's text as it is when nobody touches it for a while");
    command->add_flag("--fresh", options->fresh, "Starts anew, not as the scene's last window was left");
    command->callback([options, &chosen] { chosen = [options] { return view(*options); }; });
}

} // namespace tidemark::cli
