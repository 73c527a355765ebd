#include "cli/options.hpp"

#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/diagnostics.hpp"
#include "scene/load_scene.hpp"
#include "scene/stated_size.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

namespace tidemark::cli {

void add_scene_options(Command command, SceneRequest& request) {
    command
        .add_option("SCENE", request.path,
                    "A .glsl or .frag file with mainImage, a scene folder, or ShaderToy's .json")
        .required()
        .each(place_diagnostics);
    command.add_option("--set", request.sets, "Value of a knob (#iUniform)")
        .type_name("NAME=VALUE")
        .repeatable();
    command.add_option("--define", request.defines, "Replaces a #define or const of the scene")
        .type_name("NAME=VALUE")
        .repeatable();
    command
        .add_option("--channel", request.channels,
                    "What iChannelN reads, of Image or another pass: a file, a name as in a directive "
                    "(noise, keyboard), none; to test with: black, white, nan, texel")
        .type_name("[PASS:]N=FILE|noise|none")
        .repeatable();
    add_file_options(command, request);
}

void add_file_options(Command command, SceneRequest& request) {
    command.add_option("--media", request.files.media, "Where ShaderToy's media files are looked up by name")
        .type_name("DIR")
        .check(existing_folder());
    command.add_flag("--allow-outside", request.files.allow_outside,
                     "The scene may read files that lie outside its folder");
}

void add_precision_options(Command command, SceneRequest& request) {
    const Option precision =
        command
            .add_option(
                "--precision", [&request](const std::string& text) { request.doubles = text == "double"; },
                "double: the scene promoted to 64-bit floats [single]")
            .type_name("single|double")
            .check(one_of({"single", "double"}));
    command
        .add_flag("--double-hashes", request.double_hashes,
                  "Promotes hashes too: other random numbers, another scene")
        .needs(precision);
}

void add_device_options(Command command, platform::DeviceChoice& device) {
    command.add_option("--device", device.name, "Where to draw: a name from `tidemark inspect --devices`")
        .type_name("NAME")
        .capture_default_str();
    command.add_flag("--require-gpu", device.gpu_only,
                     "Fails where the CPU would draw instead of a graphics card");
}

void add_picture_options(Command command, FrameOptions& options) {
    command.add_option("--size", options.size, "Resolution in pixels, where the scene's #iSize says no other")
        .type_name("WxH")
        .default_str("640x360");
    command.add_option("--fps", options.fps, "Time step: iTime = frame / F, iTimeDelta = 1 / F")
        .type_name("F")
        .check(number<double>("a number"))
        .default_str("60");
    command.add_option("--date", options.date, "iDate at iTime 0, as in 2024-12-31T23:59:58")
        .type_name("ISO");
    command
        .add_option("--camera", options.camera,
                    "Orbit camera of a scene that declares iCamera or iOrbit, in degrees")
        .type_name("AZIMUTH,ELEVATION,DISTANCE[,X,Y,Z]");
    command.add_option("--pass", options.pass, "The pass to show, as in \"Buffer A\" [Image]")
        .type_name("NAME");
    command.add_option("--input", options.input, "Mouse and keyboard events by frame, from a recording")
        .type_name("FILE");
}

void add_time_options(Command command, FrameOptions& options) {
    const Option frame = command.add_option("--frame", options.frame, "One frame, from 0 (the default)")
                             .type_name("N")
                             .check(number<int>("a whole number"));
    const Option frames =
        command.add_option("--frames", options.frames, "Frames, inclusive, as in 0-29 or 0-120x10")
            .type_name("A-B[xS][,...]");
    const Option time = command.add_option("--time", options.time, "iTime in seconds, instead of a frame")
                            .type_name("T")
                            .check(number<double>("a number"));
    frame.excludes(frames).excludes(time);
    frames.excludes(time);
    command
        .add_option("--mouse", options.mouse,
                    "iMouse after a click at that pixel, or after a drag to it from another; down: in the "
                    "frame of the press, or before the drag's end")
        .type_name("X,Y[,FROM_X,FROM_Y][,down]")
        .excludes("--input");
}

std::vector<std::filesystem::path> files_read(const scene::Scene& scene, const FrameOptions& options) {
    std::vector<std::filesystem::path> files = scene.files;
    files.push_back(scene.file);
    if (options.input)
        files.emplace_back(*options.input);
    return files;
}

namespace {

template <class T>
Result<void> keep(Result<T> parsed, auto& place) {
    if (!parsed)
        return fail(std::move(parsed.error()));
    place = *std::move(parsed);
    return {};
}

/// Drops the window's clock: --frame, --frames and --time refer to a run with a constant time step from its
/// start.
void leave_window_time(FrameSequence& sequence) {
    render::FrameState& state = sequence.state;
    state.time.reset();
    state.time_delta.reset();
    if (const auto fps = std::exchange(sequence.lead_in_fps, std::nullopt))
        state.fps = *fps;
}

Result<void> resolve_time(const FrameOptions& options, FrameSequence& sequence) {
    render::FrameState& state = sequence.state;
    if (options.frame || options.frames || options.time)
        leave_window_time(sequence);
    if (options.fps && (!(*options.fps > 0) || !std::isfinite(*options.fps)))
        return fail(ErrorCode::usage, fmt::format("--fps {}: give a number above 0", *options.fps));
    if (options.fps)
        (sequence.lead_in_fps ? *sequence.lead_in_fps : state.fps) = *options.fps;
    if (options.frame && (*options.frame < 0 || *options.frame > render::k_last_frame))
        return fail(ErrorCode::usage, fmt::format("--frame {}: frames count from 0 to {}", *options.frame,
                                                  render::k_last_frame));
    if (options.frame)
        sequence.frames = {*options.frame};
    if (options.time && !std::isfinite(*options.time))
        return fail(ErrorCode::usage, "--time: give a finite number of seconds");
    if (options.time) {
        state = render::at_time(*options.time, state);
        sequence.frames = {state.frame};
    }
    return options.frames ? keep(parse_frames(*options.frames), sequence.frames) : Result<void>();
}

} // namespace

FrameOptions sized(FrameOptions options, const scene::Scene& scene) {
    if (!options.size && scene.size)
        options.size = scene::to_string(*scene.size);
    return options;
}

FrameOptions sized(FrameOptions options, const SceneRequest& request) {
    const auto scene = options.size ? Result<scene::Scene>() : scene::load_scene(request.path, request.files);
    return scene ? sized(std::move(options), *scene) : options;
}

Result<FrameSequence> resolve(const FrameOptions& options, FrameSequence base) {
    FrameSequence sequence = std::move(base);
    render::FrameState& state = sequence.state;
    if (options.size) {
        const Extent before = state.extent;
        TRY(keep(parse_size(*options.size), state.extent));
        state.mouse.stretch(before, state.extent);
    }
    TRY(resolve_time(options, sequence));
    if (options.mouse)
        TRY(keep(parse_mouse(*options.mouse), state.mouse));
    if (options.date)
        TRY(keep(render::parse_date(*options.date), state.date));
    if (options.camera) {
        TRY(keep(render::parse_camera(*options.camera), state.camera));
        state.initial_camera = state.camera;
    }
    if (!options.pass.empty())
        state.pass = options.pass;
    if (options.input) {
        sequence.input_file = *options.input;
        TRY(keep(load_input_script(*options.input), sequence.input));
    }
    return sequence;
}

} // namespace tidemark::cli
