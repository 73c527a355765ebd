#include "base/file.hpp"
#include "base/try.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"
#include "cli/interrupt.hpp"
#include "cli/limits.hpp"
#include "cli/options.hpp"
#include "cli/view/rehearsal.hpp"
#include "cli/view/viewer.hpp"
#include "platform/headless_context.hpp"
#include "render/renderer.hpp"
#include "render/sound_renderer.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

namespace tidemark::cli {
namespace {

/// X11 counts the pixels of a window in 16 bits, half of them below zero; beyond that it takes another size.
constexpr int k_largest_window = 32767;
constexpr Extent k_played{16, 16};

struct ViewOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string record;
    bool plain = false;
    bool fresh = false;
    LiveInputRequest inputs;
    LimitOptions limits;
};

/// In a process of its own: all that the window will have its driver do, once, small and in no window. What
/// is wrong otherwise, the window's own driver says.
void play(const SceneRequest& request, const std::string& pass) {
    const auto context = platform::HeadlessContext::create();
    if (!context)
        return;
    auto scene = load(request);
    if (!scene)
        return;
    if (scene->find(scene::PassKind::sound))
        if (auto sound = render::SoundRenderer::create(*scene, {}, precision_of(request)))
            sound->draw_rows(0, 1);
    auto renderer = render::Renderer::create(*std::move(scene),
                                             {k_played, image::SampleType::u8, pass, precision_of(request)});
    if (!renderer)
        return;
    renderer->warm_up({});
    renderer->draw({});
    renderer->read_back();
}

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

/// What was learned counts for somebody who records, or starts anew, too.
std::optional<Remembered> controllers_before(const ViewOptions& options) {
    auto state = options.inputs.midi ? recall(options.scene.path) : std::nullopt;
    if (!state)
        return state;
    return Remembered{.controllers = std::move(state->controllers)};
}

Result<int> view(const ViewOptions& options) {
    auto frames = TRY(resolve(options.frames));
    const bool remembers = !options.frames.input && options.record.empty();
    auto left = remembers && !options.fresh ? left_before(options, frames) : controllers_before(options);
    if (const Extent size = frames.state.extent; std::max(size.width, size.height) > k_largest_window)
        return fail(ErrorCode::usage, fmt::format("--size {}x{}: a window has at most {} pixels on a side",
                                                  size.width, size.height, k_largest_window));
    const auto limits = TRY(resolve(options.limits));
    Viewer::Settings settings{options.scene, std::move(frames)};
    settings.rehearsal = Rehearsal::start([&] { play(options.scene, options.frames.pass); }, limits.memory);
    settings.record = OutputPath::typed(options.record);
    settings.plain = options.plain;
    settings.remembers = remembers;
    settings.left = std::move(left);
    if (options.inputs.any())
        settings.inputs = options.inputs;
    // What is recorded can be drawn again: its date goes on with iTime, not with the clock.
    if (options.frames.date || options.frames.input || !options.record.empty())
        settings.date = settings.frames.state.date;
    if (!settings.record.empty())
        TRY(check_writable(settings.record));
    Interrupt interrupt;
    auto viewer = TRY(Viewer::open(std::move(settings)));
    const Interrupt::Waking waking(interrupt, platform::Window::wake);
    auto outcome = viewer.run(interrupt);
    if (viewer.busy()) { // a driver that compiles cannot be waited for
        if (!outcome)
            say(outcome.error());
        finish_diagnostics(true);
        ::_exit(outcome ? *outcome : exit_code(outcome.error().code));
    }
    return outcome;
}

void add_live_options(CLI::App& command, LiveInputRequest& inputs) {
    command
        .add_option(
            "--osc", inputs.osc,
            "Listens for OSC at that port of this machine, or at that address: /knob/NAME, /time, /play")
        ->type_name("[HOST:]PORT")
        ->excludes("--input");
    command
        .add_option("--midi", inputs.midi,
                    "Listens to the controllers of a MIDI device: a part of its port's name, or its file")
        ->type_name("PORT|FILE")
        ->excludes("--input");
    command
        .add_option("--microphone", inputs.microphone,
                    "What inputs without a sound file hear: a device of ALSA's, as in --microphone default")
        ->type_name("DEVICE")
        ->excludes("--input");
    command
        .add_option("--webcam", inputs.webcam,
                    "What webcam inputs see: a device, as in --webcam /dev/video0, or a video")
        ->type_name("DEVICE|FILE")
        ->excludes("--input");
}

} // namespace

void add_view(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command =
        app.add_subcommand("view", "Opens a window, reloads the scene on save; press H in it for the keys");
    add_scene_options(*command, options->scene);
    add_precision_options(*command, options->scene);
    add_picture_options(*command, options->frames);
    command
        ->add_option("--record", options->record,
                     "Writes what mouse and keyboard do, for --input; iTime goes by frames")
        ->type_name("FILE")
        ->excludes("--input");
    command->get_option("--fps")->description(
        "Highest frame rate; with --record or --input the time step too: iTime = frame / F");
    add_memory_option(*command, options->limits);
    command->add_flag("--plain", options->plain,
                      "Stays with the scene's text as it is when nobody touches it for a while");
    command->add_flag("--fresh", options->fresh, "Starts anew, not as the scene's last window was left");
    add_live_options(*command, options->inputs);
    command->callback([options, &chosen] { chosen = [options] { return view(*options); }; });
}

} // namespace tidemark::cli
