// The options of `view` that place its windows.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/viewer_options.hpp"
#include "host/command_line.hpp"
#include "window/gallery.hpp"
#include "window/window.hpp"
#include "window/window_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

namespace tidemark::cli {

using namespace host;
using namespace window;
using host::resolve;
using window::open_editor;
namespace {

/// The options as typed.
struct WindowOptions {
    bool on_top = false;
    bool es = false;
    std::optional<int> monitor;
    std::optional<std::string> position;
    bool output = false;
    std::optional<int> output_monitor;
};

/// Bound of plausible screen coordinates, in pixels.
constexpr int k_farthest_place = 1 << 15;

Result<window::ScreenPoint> parse_position(const std::string& text) {
    const std::vector<int> at = numbers_from<int>(text);
    const auto plausible = [](int number) { return std::abs(number) <= k_farthest_place; };
    if (at.size() != 2 || !std::ranges::all_of(at, plausible))
        return fail(
            ErrorCode::usage,
            fmt::format("--position {}: give X,Y of the window's upper left corner, as in 100,50", text));
    return window::ScreenPoint{at[0], at[1]};
}

/// Adds --on-top, --es, --monitor, --position, --output-window and --output-monitor.
void add_window_options(Command command, WindowOptions& options) {
    command.add_flag("--on-top", options.on_top, "Keeps the window above other windows");
    command.add_flag("--es", options.es, "Draws with OpenGL ES 3.1 or later instead of OpenGL 4.5");
    command
        .add_option("--monitor", options.monitor,
                    "Opens the window in the middle of that monitor; 1 is the first")
        .type_name("N")
        .check(number<int>("a monitor's number from 1", 1));
    command
        .add_option("--position", options.position,
                    "Upper left corner of the window, on the screen or on the monitor of --monitor")
        .type_name("X,Y");
    command.add_flag("--output-window", options.output, "Opens a second window that shows only the picture");
    command
        .add_option("--output-monitor", options.output_monitor,
                    "Opens that second window full screen on that monitor; 1 is the first")
        .type_name("N")
        .check(number<int>("a monitor's number from 1", 1));
}

/// Returns the placement of the first window.
Result<window::WindowWishes> resolve(const WindowOptions& options) {
    window::WindowWishes wishes;
    wishes.monitor = options.monitor;
    wishes.on_top = options.on_top;
    wishes.es = options.es;
    if (options.position)
        wishes.position = TRY(parse_position(*options.position));
    return wishes;
}

/// X11's limit: window sizes are signed 16-bit numbers. Larger windows get another size.
constexpr int k_largest_window = 32767;

struct ViewOptions : ViewerOptions {
    std::vector<std::string> others; ///< more scenes
    std::optional<RenderScale> scale;
    std::optional<double> adaptive;
    bool plain = false;
    bool paused = false;
    bool fresh = false;
    WindowOptions window;
    LiveInputRequest inputs;
};

/// Returns the saved state of the last window, without what the options override. `sized`: the size is given
/// by an option or by the file.
std::optional<Remembered> left_before(const ViewOptions& options, bool sized, FrameSequence& frames) {
    auto state = recall(options.scene.path);
    if (!state)
        return state;
    if (state->place && !sized)
        frames.state.extent = state->place->size;
    if (state->moment && options.frames.camera)
        state->moment->sequence.state.camera = frames.state.camera;
    if (state->moment)
        erase_named(options.scene.sets, state->moment->sequence.state.knobs);
    return state;
}

RenderScale first_scale(const ViewOptions& options, const std::optional<Remembered>& left) {
    if (options.scale)
        return *options.scale;
    return left && left->scale ? *left->scale : RenderScale();
}

/// Returns the learned MIDI bindings, which also apply while recording and with --fresh.
std::optional<Remembered> controllers_before(const ViewOptions& options) {
    auto state = options.inputs.midi ? recall(options.scene.path) : std::nullopt;
    if (!state)
        return state;
    return Remembered{.controllers = std::move(state->controllers)};
}

/// Returns false if TIDEMARK_MESSAGES=off hides the short messages over the picture.
bool shows_messages() {
    const char* const wish = std::getenv("TIDEMARK_MESSAGES");
    return !wish || std::string_view(wish) != "off";
}

std::string existing_scene(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) ? "" : fmt::format("there is no file '{}'", path);
}

/// The settings with which `view` opens a scene.
struct Opening {
    Viewer::Settings settings;
    Extent size{};
};

/// Resolves the options for their scene. `gallery`: it is opened in a window that has shown others.
Result<Opening> opening_of(const ViewOptions& options, const std::shared_ptr<EditorTexts>& editor,
                           bool gallery) {
    const FrameOptions typed = sized(options.frames, options.scene);
    auto frames = TRY(resolve(typed));
    const bool remembers = !options.by_frames();
    const bool keeps = remembers && options.scene.path != "-";
    auto left = keeps && !options.fresh ? left_before(options, typed.size.has_value(), frames)
                                        : controllers_before(options);
    const Extent size = frames.state.extent;
    if (std::max(size.width, size.height) > k_largest_window)
        return fail(ErrorCode::usage, fmt::format("--size {}x{}: a window has at most {} pixels on a side",
                                                  size.width, size.height, k_largest_window));
    auto settings = TRY(resolve(options, std::move(frames), editor, !gallery));
    settings.opens_others = remembers;
    settings.in_gallery = gallery && remembers;
    settings.scale = first_scale(options, left);
    settings.adaptive = options.adaptive;
    settings.plain = options.plain;
    settings.paused = options.paused;
    settings.messages = shows_messages();
    settings.remembers = keeps;
    settings.left = std::move(left);
    if (options.inputs.any())
        settings.inputs = options.inputs;
    return Opening{std::move(settings), size};
}

/// Returns the scenes that the options name.
std::vector<std::filesystem::path> scenes_in(const ViewOptions& options) {
    std::vector<std::filesystem::path> paths{options.scene.path};
    paths.insert(paths.end(), options.others.begin(), options.others.end());
    return scene::scenes_of(paths);
}

/// Returns the options with which `capture` draws thumbnails.
std::vector<std::string> thumbnail_words(const ViewOptions& options) {
    SceneRequest files;
    files.files.media = options.scene.files.media;
    files.files.allow_outside = options.scene.files.allow_outside;
    return option_words(files);
}

Result<int> view(ViewOptions options) {
    const auto editor = TRY(open_editor(options));
    const bool gallery = !options.others.empty() || scene::is_folder_of_scenes(options.scene.path);
    if (gallery && (options.by_frames() || editor))
        return fail(ErrorCode::usage, fmt::format("{} one scene, not several",
                                                  editor ? "--editor needs" : "--record and --input need"));
    Gallery scenes(gallery ? scenes_in(options) : std::vector{options.scene.path}, thumbnail_words(options));
    window::WindowWishes wishes = TRY(resolve(options.window));
    std::optional<Viewer::Settings> first;
    Extent size = TRY(resolve(options.frames)).state.extent;
    if (!gallery) {
        auto opening = TRY(opening_of(options, editor, false));
        if (opening.settings.left)
            wishes.left_at = opening.settings.left->place;
        size = opening.size;
        first = std::move(opening.settings);
    }
    std::optional<WindowScreen::Output> second;
    if (options.window.output || options.window.output_monitor)
        second = WindowScreen::Output{options.window.output_monitor};
    const auto next = [&](const Viewer::Leave& leave, Screen& screen,
                          const Interrupt& interrupt) -> Result<std::optional<Viewer::Settings>> {
        using To = Viewer::Leave::To;
        bool chosen = leave.to == To::next || leave.to == To::previous;
        if (chosen)
            scenes.move(leave.to == To::next ? 1 : -1);
        if (leave.to == To::files) {
            const auto dropped = scene::scenes_of({leave.files.begin(), leave.files.end()});
            if (!dropped.empty())
                scenes.add(dropped);
            chosen = dropped.size() <= 1;
        }
        if (!chosen && !TRY(scenes.run(screen, interrupt)))
            return std::nullopt;
        ViewOptions one = options;
        one.scene.path = scenes.selected();
        auto opening = TRY(opening_of(one, nullptr, true));
        return std::move(opening.settings);
    };
    return show(
        std::move(first),
        [&](const std::string& title) { return WindowScreen::open(size, title, wishes, second); }, next);
}

void add_scale_options(Command command, ViewOptions& options) {
    std::vector<std::string> names;
    for (const RenderScale scale : RenderScale::all())
        names.push_back(scale.name());
    command
        .add_option(
            "--scale", [&options](const std::string& name) { options.scale = RenderScale::named(name); },
            "Initial render scale: rendered pixels per window pixel, along a side [1]")
        .type_name(fmt::format("{}", fmt::join(names, "|")))
        .check(one_of(names));
    command.add_option("--adaptive", options.adaptive, "Changes the render scale to keep that frame rate")
        .type_name("FPS")
        .check(number<double>("a frame rate from 1 to 1000", 1, 1000))
        .excludes("--record")
        .excludes("--input");
}

void add_live_options(Command command, LiveInputRequest& inputs) {
    command
        .add_option("--osc", inputs.osc,
                    "Receives OSC at that port, or at that address: /knob/NAME, /time, /play")
        .type_name("[HOST:]PORT")
        .excludes("--input");
    command
        .add_option("--midi", inputs.midi,
                    "Reads the controllers of a MIDI device: a part of its port's name, or its device file")
        .type_name("PORT|FILE")
        .excludes("--input");
    command
        .add_option("--microphone", inputs.microphone,
                    "ALSA device for inputs that have no sound file, as in --microphone default")
        .type_name("DEVICE")
        .excludes("--input");
    command
        .add_option("--webcam", inputs.webcam,
                    "Source for webcam inputs: a device, as in --webcam /dev/video0, or a video file")
        .type_name("DEVICE|FILE")
        .excludes("--input");
}

} // namespace

void add_view(Command app, Action& chosen) {
    auto options = std::make_shared<ViewOptions>();
    Command command = app.add_subcommand(
        "view", "Opens a window and reloads the scene on save; press H in it for the keys");
    add_viewer_options(command, *options);
    command
        .add_option("SCENES", options->others,
                    "More scenes: thumbnails of all to choose from, as for a folder of scenes")
        .check(existing_scene);
    add_scale_options(command, *options);
    add_window_options(command, options->window);
    command.add_flag("--paused", options->paused, "Opens the window paused");
    command.add_flag("--plain", options->plain, "Turns off background optimisation");
    command.add_flag("--fresh", options->fresh, "Ignores the remembered state of the scene's last window");
    add_live_options(command, options->inputs);
    command.on_call([options, &chosen] { chosen = [options] { return view(*options); }; });
}

} // namespace tidemark::cli
