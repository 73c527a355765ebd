// `--like PICTURE`: takes the moment from a picture's metadata for everything that the command line leaves
// open.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "cli/capture_delivery.hpp"
#include "cli/capture_plan.hpp"
#include "cli/capture_resume.hpp"
#include "cli/capture_run.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/fingerprint.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/moment.hpp"
#include "host/program_trial.hpp"
#include "host/scene_report.hpp"
#include "host/supervision.hpp"
#include "media/picture_check.hpp"
#include "media/sound_file.hpp"
#include "media/video_output.hpp"
#include "render/gl_context.hpp"
#include "render/renderer.hpp"
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <thread>

namespace tidemark::cli {

using namespace host;
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> refuse(const std::string& picture, std::string_view why) {
    return fail(ErrorCode::usage, fmt::format("--like {}: {}", picture, why));
}

Result<Moment> read_moment(const std::string& picture, const image::Metadata& metadata) {
    const std::string* text = image::find(metadata, k_moment);
    if (!text)
        return refuse(picture,
                      "the file has no record of how it was drawn; give a picture from `tidemark capture` or "
                      "from the window's S key, not .hdr and not saved again by another program");
    auto moment = moment_of(parse_or_discard(*text));
    if (!moment)
        return refuse(picture, "its record of how it was drawn is damaged: " + moment.error().message);
    return moment;
}

/// Removes paths that lead out of the scene's folder, which the scene's own text could not use either.
void keep_inside(const std::string& picture, const SceneRequest& typed, Moment& moment) {
    std::error_code ignored;
    const fs::path scene = typed.path;
    const scene::Bounds bounds(fs::is_directory(scene, ignored) ? scene : scene.parent_path(),
                               typed.files.allow_outside);
    const auto leads_out = [&](const std::string& option, const fs::path& file) {
        if (file.empty() || bounds.check(file))
            return false;
        say(fmt::format(
            "--like {}: ignored {}: it is outside the scene's folder (--allow-outside permits it)", picture,
            option));
        return true;
    };
    std::erase_if(moment.scene.channels, [&](const std::string& channel) {
        const scene::ChannelInput input = scene::input_of_name(channel.substr(channel.find('=') + 1), {});
        for (const fs::path& file : input_files(input))
            if (leads_out("--channel " + channel, file))
                return true;
        return false;
    });
    if (leads_out("--media " + moment.scene.files.media.string(), moment.scene.files.media))
        moment.scene.files.media.clear();
    if (leads_out("--input " + moment.sequence.input_file, moment.sequence.input_file))
        moment.sequence.input_file.clear();
}

/// Returns the metadata value of that name, if it is a number within the limits of its option.
template <class T>
std::optional<T> number_in(const image::Metadata& metadata, std::string_view name, T low, T high) {
    const std::string* const text = image::find(metadata, name);
    const auto number = text ? number_from<T>(*text) : std::nullopt;
    return number && *number >= low && *number <= high ? number : std::nullopt;
}

/// Takes --crop, --samples and --shutter from the metadata if they are not given. A crop is of one pass and
/// one size, so with another of them it is not taken.
void take_options(const image::Metadata& metadata, CaptureOptions& options) {
    const std::string* const crop = image::find(metadata, k_crop);
    const std::string* const pass = image::find(metadata, "Pass");
    const bool same_pass = options.frames.pass.empty() || (pass && *pass == options.frames.pass);
    if (crop && !options.crop && !options.frames.size && same_pass && parse_rectangle(*crop))
        options.crop = *crop;
    if (!options.drawing.samples)
        options.drawing.samples = number_in(metadata, "Samples", 1, render::k_most_samples);
    if (!options.drawing.shutter)
        options.drawing.shutter = number_in(metadata, "Shutter", 0.0, 1.0);
}

/// Fills everything not given on the command line from the moment.
SceneRequest completed(SceneRequest typed, Moment& moment) {
    SceneRequest& scene = moment.scene;
    typed.sets = merged(std::move(scene.sets), typed.sets);
    typed.defines = merged(std::move(scene.defines), typed.defines);
    typed.channels = merged(std::move(scene.channels), typed.channels);
    if (typed.files.media.empty())
        typed.files.media = scene.files.media;
    if (!typed.doubles)
        typed.doubles = scene.doubles;
    typed.double_hashes |= scene.double_hashes;
    typed.knobs_may_go = true; // another text may have other knobs
    return typed;
}

/// Prints a line if the picture was drawn from another text, with other inputs, or by another driver.
void say_what_is_unlike(const CapturePlan& plan) {
    if (plan.options.like.picture.empty())
        return;
    const Fingerprint there = Fingerprint::parse(plan.options.like.fingerprint).of_scene();
    if (const std::string other = plan.identity.of_scene().differences(there); !other.empty())
        say(fmt::format("the picture may differ from {}: {}", plan.options.like.picture, other));
}

/// Returns an upper bound of the state's size in bytes: two textures per buffer with four floats a pixel,
/// each at most as large as the frame or a cubemap.
uint64_t largest_state(const CapturePlan& plan) {
    constexpr uint64_t k_cubemap = 6 * 1024 * 1024, k_header = 1 << 20;
    const auto pixels = std::max<uint64_t>(plan.drawing.options.extent.pixels(), k_cubemap);
    return k_header + plan.scene.passes.size() * 2 * pixels * 4 * sizeof(float);
}

/// Returns the newest state from which the rest of the capture can start. If there is none, a newer one
/// supplies only the program that was chosen.
std::optional<SavedState> find_state(const CapturePlan& plan) {
    std::optional<SavedState> too_new;
    for (const std::filesystem::path& file : find_states(plan.output)) {
        auto state = read_state(
            file, [&](int frame) { return plan.identity_of(frame); }, largest_state(plan));
        if (state && state->frame <= plan.frames.frames.front())
            return state;
        if (state && !too_new)
            too_new = SavedState{state->frame, state->program};
    }
    return too_new;
}

void say_what_was_written(const FrameRecords& records, const CapturePlan& plan) {
    if (plan.output.video() && plan.shard)
        say(fmt::format("wrote {} of {} as segments; `tidemark gather` joins them",
                        counted_frames(records.count()), plan.output.pattern().string()));
    else if (plan.output.video())
        say(fmt::format("wrote {}: {}{}", plan.output.pattern().string(),
                        counted_frames(plan.kept.size() + records.count()),
                        plan.video.pace.fps == plan.frames.state.fps
                            ? ""
                            : fmt::format(", {:.4g} a second", plan.video.pace.fps)));
    else if (plan.area.sheet)
        say(fmt::format("wrote {}: {} moments, frames {} to {}", records.first().file, records.count(),
                        records.first().frame, records.last().frame));
    else if (records.count() == 1)
        say(fmt::format("wrote {}", records.first().file));
    else if (records.count() > 0)
        say(fmt::format("wrote {} frames, {} to {}", records.count(), records.first().file,
                        records.last().file));
}

/// Prints one line for all frames, naming the first with such pixels; nothing if there is none. The file does
/// not show such pixels.
void warn_of(const FrameRecords::Found& found,
             const std::function<std::string(const FrameRecord&, const std::string& others)>& words) {
    if (!found.first)
        return;
    const size_t others = found.count - 1;
    say("warning: " +
        words(*found.first,
              others == 0 ? "" : fmt::format(" (and of {} other frame{})", others, others > 1 ? "s" : "")));
}

void say_what_pixels_hold(const FrameRecords& records, const CapturePlan& plan) {
    warn_of(records.not_finite(), [&](const FrameRecord& first, const std::string& others) {
        return fmt::format("{} not finite{}; find the origin with: {}",
                           pixels_are(first.not_finite, fmt::format("of frame {}", first.frame)), others,
                           trace_command(plan.options.scene, plan.frames, plan.states(first.frame)));
    });
    const bool clamped = !plan.to_picture_files() || plan.encoding.depth == image::SampleDepth::u8 ||
                         plan.encoding.depth == image::SampleDepth::u16;
    warn_of(records.no_coverage(), [&](const FrameRecord& first, const std::string& others) {
        return fmt::format("alpha is below 0 or above 1 in {} pixel{} of frame {}{}; {}", first.no_coverage,
                           first.no_coverage > 1 ? "s" : "", first.frame, others,
                           clamped ? "the file stores them as 0 or 1" : "the file stores them unchanged");
    });
}

/// Removes frames that already exist from the plan, and prints how many there are.
void keep_what_is_there(CapturePlan& plan) {
    const size_t all = plan.frames.frames.size();
    const KeptFrames kept = leave_out_kept(plan);
    for (const std::string& line : kept.said)
        say(line);
    say(fmt::format("kept {} of {}", kept.frames.size(), counted_frames(all)));
    plan.kept = kept.frames;
}

/// Removes files of an earlier run, which may have overlapped with this one, and saved states that have
/// become unnecessary.
void tidy_up(const CapturePlan& plan) {
    if (plan.options.run.resume)
        for (const OutputPath& file : {plan.output.of_frame(0), state_file(plan.output, 0)})
            StagedFile::remove_abandoned(file);
    if (!plan.shard && !plan.output.standard_output())
        remove_states(plan.output);
}

std::string interruption(const CapturePlan& plan, Capture& run) {
    const std::string words = words_on_resuming(plan, run.whole_frames());
    return fmt::format("interrupted after {} of {}{}{}", plan.kept.size() + run.records().count(),
                       counted_frames(plan.kept.size() + plan.frames.frames.size()),
                       plan.output.video() ? "; no video was written"
                       : plan.area.sheet   ? "; no sheet was written"
                                           : "",
                       words.empty() ? "" : "; " + words);
}

/// Removes existing frames from the plan, and returns the state from which the rest starts.
std::optional<SavedState> take_up(CapturePlan& plan) {
    if (plan.options.run.resume)
        keep_what_is_there(plan);
    else if (plan.frames.frames.empty())
        say(plan.output.video() ? "this shard has nothing to draw: there are more shards than video "
                                  "segments; a smaller --state-every makes more segments"
                                : "this shard has nothing to draw: there are more shards than frames");
    if (plan.frames.frames.empty() || !(plan.options.run.resume || plan.shard))
        return std::nullopt;
    auto state = find_state(plan);
    if (state && !plan.shard) { // all shards must draw the same program, whatever another capture chose
        plan.drawing.options.specialise = state->program;
        plan.drawing.trial.reset();
    }
    return state;
}

Result<bool> draw(Capture& run, const CapturePlan& plan, Interrupt& interrupt) {
    return run.run(interrupt).map_error([&](Error error) {
        if (const std::string words = words_on_resuming(plan, run.whole_frames()); !words.empty())
            error.message += "; " + words;
        return error;
    });
}

/// Prints a warning if the video's sides are odd, so that H.264 and HEVC cannot halve the resolution of its
/// colours.
void warn_odd_sides(const CapturePlan& plan) {
    const Extent size = plan.area.written;
    if (!plan.output.video() || !image::odd_sides_keep_colours(plan.output.pattern(), plan.video.codec) ||
        (size.width % 2 == 0 && size.height % 2 == 0))
        return;
    Rectangle area = plan.area.crop.value_or(Rectangle{0, 0, size});
    area.extent = {size.width & ~1, size.height & ~1};
    say(fmt::format("warning: {}x{} is an odd size: the video stores colours at full resolution (4:4:4), "
                    "which many players refuse; give --pad even{}",
                    size.width, size.height,
                    area.extent.pixels() > 0 ? " or --crop " + to_string(area) : std::string()));
}

Result<void> report(Capture& run, const CapturePlan& plan, bool complete) {
    if (plan.options.run.json)
        TRY(put(dump(run.report(), 2) + "\n"));
    say_what_pixels_hold(run.records(), plan);
    if (complete && run.records().count() > 0)
        if (const std::string warning = run.cut_loops_warning(); !warning.empty())
            say(warning);
    const bool written = complete || !(plan.output.video() || plan.area.sheet);
    if (written && !plan.options.run.json && !plan.output.standard_output())
        say_what_was_written(run.records(), plan);
    if (complete && plan.options.run.loop && run.loop().closed())
        say(run.loop().words(plan.frames.frames));
    if (!complete)
        say(interruption(plan, run));
    return {};
}

Result<int> capture_frames(CapturePlan plan) {
    Interrupt interrupt;
    std::jthread codec; // loads in parallel with the driver, which takes as long
    if (plan.to_picture_files())
        codec = image::preload_picture_codec(plan.output.pattern());
    const auto context = TRY(host::HeadlessContext::create(plan.options.run.device));
    plan.identity.set_device(gl::query_capabilities());
    say_what_is_unlike(plan);
    warn_odd_sides(plan);
    const std::optional<StagedFile> sound = draw_sound_of_video(plan, interrupt);
    const std::optional<SavedState> state = take_up(plan);
    if (plan.frames.frames.empty() && (plan.to_picture_files() || plan.shard) && !plan.options.run.json) {
        tidy_up(plan);
        return 0;
    }
    auto compiled = TRY(compile(plan, interrupt));
    Capture run(plan, compiled, sound ? sound->path() : std::filesystem::path());
    if (state)
        run.start_from(*state);
    const bool complete = TRY(draw(run, plan, interrupt));
    if (complete)
        tidy_up(plan);
    TRY(report(run, plan, complete));
    if (complete && plan.options.run.loop && run.loop().closed() && !run.loop().seamless())
        return exit_code(ErrorCode::check_failed);
    return complete ? 0 : Interrupt::k_exit_code;
}

Result<int> capture(const CaptureOptions& typed) {
    const CaptureOptions options = TRY(with_likeness(typed));
    return wants_sound(options) ? plan_sound(options).and_then(capture_sound)
                                : plan_capture(options).and_then(capture_frames);
}

} // namespace

Result<CaptureOptions> with_likeness(CaptureOptions options) {
    SceneRequest& scene = options.scene;
    if (options.like.picture.empty())
        return scene.path.empty()
                   ? Result<CaptureOptions>(fail(ErrorCode::usage, "capture: SCENE is required"))
                   : std::move(options);
    const auto metadata = image::read_metadata(options.like.picture);
    if (!metadata)
        return refuse(options.like.picture, metadata.error());
    Moment moment = TRY(read_moment(options.like.picture, *metadata));
    const Extent size = moment.sequence.state.extent;
    if (!options.frames.size && std::max(size.width, size.height) > scene::k_largest_stated_side)
        return refuse(options.like.picture,
                      fmt::format("its recorded size is {}x{}; the limit for a recorded size "
                                  "is {} pixels on a side: give --size",
                                  size.width, size.height, scene::k_largest_stated_side));
    std::error_code ignored;
    if (scene.path.empty() && !fs::exists(moment.scene.path, ignored))
        return refuse(
            options.like.picture,
            fmt::format(
                "its scene '{}' was not found: name the scene, as in `tidemark capture SCENE --like {}`",
                moment.scene.path.string(), options.like.picture));
    if (scene.path.empty())
        scene.path = moment.scene.path;
    keep_inside(options.like.picture, scene, moment);
    erase_named(scene.sets, moment.sequence.state.knobs);
    if (!moment.sequence.input_file.empty() && !options.frames.input) {
        options.frames.input = moment.sequence.input_file;
        moment.sequence.state = without_recorded(std::move(moment.sequence.state));
    }
    scene = completed(std::move(scene), moment);
    take_options(*metadata, options);
    const std::string* fingerprint = image::find(*metadata, k_fingerprint);
    options.like.frames = std::move(moment.sequence);
    options.like.fingerprint = fingerprint ? *fingerprint : "";
    return options;
}

void add_codec_option(Command command, std::string& codec) {
    command
        .add_option("--codec", codec,
                    "Video codec; .mp4 and .mkv: h264 (8 bits), hevc or av1 (10 bits); .webm: vp9 (8 bits) "
                    "or av1 (10 bits) [the first]")
        .type_name("h264|hevc|av1|vp9");
}

void add_capture_options(Command command, CaptureOptions& options) {
    add_scene_options(command, options.scene);
    add_precision_options(command, options.scene);
    add_picture_options(command, options.frames);
    add_time_options(command, options.frames);
    command.option("SCENE").required(false); // --like may name it
    command
        .add_option("--like", options.like.picture,
                    "Draws the moment recorded in a picture's metadata; SCENE and options on the command "
                    "line override it")
        .type_name("PICTURE");
    command
        .add_option("-o,--output", options.output,
                    "File: a picture (.png .jpg .tif .exr .hdr; %04d or #### numbers a sequence, {} the six "
                    "faces of a cube), a video (.mp4 .mkv .webm .mov .gif .webp), or - for raw RGB frames on "
                    "standard output [SCENE.png]")
        .type_name("OUT");
    command
        .add_option("--depth", options.encoding.depth,
                    "Bits per channel in the file [the format's usual depth; a --pass in .exr: float]")
        .type_name("8|16|half|float");
    command
        .add_option("--transfer", options.encoding.transfer,
                    "Encoding of the samples: srgb, as Image writes them, or linear light, which needs at "
                    "least 16 bits [srgb; another --pass is stored unchanged]")
        .type_name("srgb|linear");
    add_codec_option(command, options.encoding.codec);
    command
        .add_option("--alpha", options.encoding.alpha,
                    "Alpha of Image: opaque: 1, as on ShaderToy; keep: as the shader writes it; "
                    "premultiplied: also multiplies the colours by it [opaque]")
        .type_name("opaque|keep|premultiplied");
    command
        .add_option("--crop", options.crop,
                    "Writes that part alone: left, bottom, width and height in pixels from the bottom left")
        .type_name("X,Y,W,H");
    command
        .add_option("--pad", options.encoding.pad,
                    "Repeats the last column and row of a video where needed, so that both sides are even")
        .type_name("even")
        .check(one_of({"even"}));
    command
        .add_option(
            "--audio", options.encoding.audio,
            "Sound of a video or a .wav: the Sound pass (sound), the channels that read sound files or "
            "videos (inputs), both or none [both]")
        .type_name("sound|inputs|both|none")
        .check(one_of({"sound", "inputs", "both", "none"}));
    command.add_flag(
        "--layers", options.encoding.layers,
        "Writes all passes into one .exr, each as a part with the pass's name; a cube as six parts");
    add_device_options(command, options.run.device);
    command.add_flag("--es", options.run.es,
                     "Draws with OpenGL ES 3.1 or later, whose compiler is as strict as ShaderToy's");
    command
        .add_option("--timeout", options.run.timeout,
                    "Stops with exit code 5 when compiling, the first draw or one frame takes longer")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds"));
    command
        .add_option(
            "--from", options.time.from,
            "Start of the time to capture, instead of --frames: the frame nearest to it is the first [0]")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds"));
    command.add_option("--to", options.time.to, "End of that time; the frame at it is left out")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds"));
    command
        .add_option("--duration", options.time.duration,
                    "Length of that time, instead of --to [a .wav: 60, a --sheet: 10]")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds"));
    const Option plain =
        command.add_flag("--plain", options.drawing.plain, "Compiles the scene without optimising its text");
    command
        .add_option("--allow-difference", options.drawing.allowed_difference,
                    "Compiles knobs as constants if that is faster and no sample changes by more than MAX")
        .type_name("MAX")
        .check(number<double>("a number"))
        .excludes(plain)
        .excludes("--timeout"); // frames of a trial have no time limit
    command
        .add_option("--tile", options.drawing.tile,
                    "Draws in tiles of N pixels a side, an even number [1024x256 above 4096x2160 pixels]")
        .type_name("N")
        .check(number<int>("a whole number"));
    command
        .add_option(
            "--samples", options.drawing.samples,
            "Smooths edges: each frame is the mean, in linear light, of N frames shifted by parts of a pixel")
        .type_name("N")
        .check(number<int>("a whole number from 1 to 65536", 1, render::k_most_samples))
        .excludes("--allow-difference");
    command
        .add_option("--shutter", options.drawing.shutter,
                    "Motion blur: spreads the samples over this part of the time to the next frame, 0 to 1 "
                    "[16 samples]")
        .type_name("PART")
        .check(number<double>("a number from 0 to 1", 0, 1))
        .excludes("--allow-difference");
    const Option resume =
        command.add_flag("--resume", options.run.resume,
                         "Continues an interrupted capture: keeps the frames that exist already");
    command
        .add_option("--state-every", options.run.state_every,
                    "Saves the buffers after every so many frames, for --resume of a scene with feedback")
        .type_name("FRAMES")
        .check(positive_number());
    command
        .add_option("--shard", options.run.shard,
                    "Draws share K of N, for several processes or machines; slurm: takes K and N from a "
                    "Slurm array task")
        .type_name("K/N|slurm");
    command
        .add_flag("--loop", options.run.loop,
                  "Tests whether the sequence loops: compares the frame after the last with the first; exit "
                  "code 1 if "
                  "it does not")
        .excludes(resume)
        .excludes("--shard");
    command
        .add_option(
            "--sheet", options.sheet,
            "One picture with a grid of moments, each of --size, taken evenly from --frames or --duration")
        .type_name("COLUMNSxROWS")
        .excludes("--layers")
        .excludes("--tile")
        .excludes(resume)
        .excludes("--state-every")
        .excludes("--shard")
        .excludes("--loop");
    command
        .add_option("--lens", options.lens,
                    "Draws a number per pixel instead of the picture: cost, steps, error, rounding, proof, "
                    "clocks, value:LINE or branch:LINE; an .exr holds the numbers")
        .type_name("LENS")
        .excludes("--layers")
        .excludes("--tile")
        .excludes("--samples")
        .excludes("--shutter")
        .excludes("--crop")
        .excludes("--allow-difference");
    command.add_flag("--json", options.run.json, "Prints one JSON object about the frames");
}

void add_capture(Command app, Action& chosen) {
    auto options = std::make_shared<CaptureOptions>();
    Command command =
        app.add_subcommand("capture", "Makes pictures, raw frames or a video of a scene; needs no display");
    add_capture_options(command, *options);
    command.on_call([options, command, &chosen] {
        options->run.words =
            command.typed_words(std::array<std::string_view, 3>{"--shard", "--resume", "--json"});
        chosen = [options] { return capture(*options); };
    });
}

} // namespace tidemark::cli
