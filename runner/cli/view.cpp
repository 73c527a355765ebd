#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/options.hpp"
#include "cli/viewer.hpp"

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <memory>

namespace tidemark::cli {
namespace {

struct ViewOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string record;
};

Result<int> view(const ViewOptions& options) {
    auto frames = resolve(options.frames);
    if (!frames)
        return fail(std::move(frames.error()));
    Viewer::Settings settings{options.scene, *std::move(frames)};
    settings.pass = options.frames.pass;
    settings.record = options.record;
    if (options.frames.date)
        settings.date = settings.frames.date;
    auto viewer = Viewer::open(std::move(settings));
    if (!viewer)
        return fail(std::move(viewer.error()));
    auto outcome = viewer->run();
    if (viewer->busy()) { // a driver that compiles cannot be waited for
        if (!outcome)
            say(to_string(outcome.error()));
        ::_exit(outcome ? *outcome : exit_code(outcome.error().code));
    }
    return outcome;
}

} // namespace

void add_view(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command =
        app.add_subcommand("view", "Opens a window, reloads the scene on save; press H in it for the keys");
    add_scene_options(*command, options->scene);
    add_precision_options(*command, options->scene);
    add_picture_options(*command, options->frames);
    command->add_option("--record", options->record, "Writes what mouse and keyboard do, for --input")
        ->type_name("FILE");
    command->callback([options, &chosen] { chosen = [options] { return view(*options); }; });
}

} // namespace tidemark::cli
