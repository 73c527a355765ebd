#include "base/file.hpp"
#include "cli/capture/capture_run.hpp"
#include "cli/capture/capture_sound.hpp"
#include "cli/capture/video_pace.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/json_dump.hpp"
#include "cli/not_finite.hpp"
#include "cli/options.hpp"
#include "cli/sequence.hpp"
#include "cli/trial.hpp"
#include "cli/value_check.hpp"
#include "gl/capabilities.hpp"
#include "image/files/video_writer.hpp"
#include "platform/headless_context.hpp"
#include "render/renderer.hpp"
#include "sound/sound_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <unordered_set>

namespace tidemark::cli {
namespace {

using image::SampleDepth;
using image::SampleType;

struct CaptureOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::optional<std::string> output;
    std::string depth;
    std::string device = "auto";
    std::optional<double> timeout;
    double duration = 60;
    bool plain = false;
    std::optional<double> allowed_difference;
    std::optional<int> tile;
    bool json = false;
};

/// A buffer is state: a half would make infinity of 1e6. So a pass that was asked for keeps its floats.
SampleDepth default_depth(const OutputName& output, const std::string& pass) {
    const SampleDepth natural = image::natural_depth(output.pattern());
    const bool shown = pass.empty() || pass == "Image";
    return natural == SampleDepth::half && !shown ? SampleDepth::f32 : natural;
}

Result<SampleDepth> parse_depth(const std::string& text, const OutputName& output, const std::string& pass) {
    constexpr std::pair<std::string_view, SampleDepth> k_depths[] = {{"8", SampleDepth::u8},
                                                                     {"16", SampleDepth::u16},
                                                                     {"half", SampleDepth::half},
                                                                     {"float", SampleDepth::f32}};
    const bool raw = output.standard_output() || output.video();
    if (raw && !text.empty())
        return fail(ErrorCode::usage, "--depth: videos and raw frames on standard output always have 8 bits");
    if (text.empty())
        return raw ? SampleDepth::u8 : default_depth(output, pass);
    for (const auto& [name, depth] : k_depths)
        if (name == text)
            return depth;
    return fail(ErrorCode::usage, fmt::format("--depth {}: give 8, 16, half or float", text));
}

/// A frame that is named twice (`0-9,5-14`) is one file.
void drop_repeats(std::vector<int>& frames) {
    std::unordered_set<int> seen;
    std::erase_if(frames, [&](int frame) { return !seen.insert(frame).second; });
}

Result<CapturePlan> plan_capture(const CaptureOptions& options) {
    auto frames = resolve(options.frames);
    if (!frames)
        return fail(std::move(frames.error()));
    const size_t count = std::unordered_set(frames->frames.begin(), frames->frames.end()).size();
    auto output = options.output ? OutputName::parse(*options.output, count)
                                 : OutputName::of_scene(options.scene.path, count);
    if (!output)
        return fail(std::move(output.error()));
    if (!output->standard_output() && !output->video())
        drop_repeats(frames->frames);
    const auto depth = parse_depth(options.depth, *output, options.frames.pass);
    if (!depth)
        return fail(depth.error());
    const double video_fps = pace_of(frames->frames, frames->fps).fps;
    if (output->video() && output->pattern().extension() == ".gif" && video_fps > image::k_fastest_gif)
        return fail(ErrorCode::usage, fmt::format("--fps {}: a GIF shows {} frames a second at most",
                                                  options.frames.fps, image::k_fastest_gif));
    if (!output->standard_output() && !output->video()) {
        if (auto known = image::check_picture_format(output->pattern(), *depth); !known)
            return fail(std::move(known.error()));
        if (auto fits = image::PictureStream::check_extent(output->pattern(), frames->extent); !fits)
            return fail(std::move(fits.error()));
    }
    if (options.tile && output->video())
        return fail(ErrorCode::usage, "--tile: the frames of a video are drawn whole");
    if (options.timeout && !(*options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    return CapturePlan{*std::move(frames), *std::move(output),    *depth,   options.timeout,
                       options.json,       options.scene.defines, video_fps};
}

/// What is read must not be written, even by a frame late in a sequence: it is refused before the first.
Result<void> spare_what_is_read(const scene::Scene& scene, const CaptureOptions& options, CapturePlan& plan) {
    const std::vector<std::filesystem::path> read = files_read(scene, options.frames);
    if (plan.output.standard_output())
        return {};
    plan.output.spare(read);
    if (auto writable = check_writable(plan.output.of_frame(plan.frames.frames.front())); !writable)
        return writable;
    for (const std::filesystem::path& file : read)
        if (const auto frame = frame_of(file, plan.output);
            frame && std::ranges::find(plan.frames.frames, *frame) != plan.frames.frames.end())
            if (auto place = plan.output.of_frame(*frame).place(); !place)
                return fail(std::move(place.error()));
    return {};
}

/// In fewer frames a trial of another program does not pay.
constexpr size_t k_frames_worth_a_trial = 64;

/// A trial looks at the first frame that is drawn and at the last, as the sequence sees them but for what
/// buffers hold: they are empty.
TrialPlan plan_trial(const scene::Scene& scene, const CaptureOptions& options, const FrameRequest& request) {
    const int first = scene.passes.size() > 1 ? 0 : request.frames.front(); // buffers begin at frame 0
    const auto inputs_at = [&](int frame) {
        render::FrameInputs inputs = inputs_of(request, frame);
        if (request.input)
            Replay(*request.input, request.camera).fill(inputs, request.extent.height);
        return inputs;
    };
    return {inputs_at(first), inputs_at(request.frames.back()), request.frames.size(),
            options.allowed_difference};
}

/// The size of the tiles; nothing where frames are drawn whole.
Result<std::optional<Extent>> choose_tile(const CaptureOptions& options, const CapturePlan& plan,
                                          SampleType samples) {
    const Extent extent = plan.frames.extent;
    const int limit = gl::query_capabilities().largest_target;
    if (std::max(extent.width, extent.height) > render::k_largest_tiled_side)
        return fail(ErrorCode::usage, fmt::format("--size {}x{}: a side has at most {} pixels", extent.width,
                                                  extent.height, render::k_largest_tiled_side));
    if (options.tile)
        return render::tile_of_side(*options.tile, limit).map([](Extent tile) {
            return std::optional(tile);
        });
    if (plan.output.video())
        return std::nullopt;
    return render::tile_for(extent, 4 * image::size_of(samples), limit);
}

/// Where it pays, the faster of two programs; in tiles too large a picture is drawn to draw it for a trial.
Result<render::Renderer> choose_renderer(const scene::Scene& scene, const CaptureOptions& options,
                                         const CapturePlan& plan, render::RenderOptions target) {
    const bool long_enough = plan.frames.frames.size() >= k_frames_worth_a_trial && !plan.timeout;
    if (options.plain || target.tile || !(options.allowed_difference || long_enough))
        return render::Renderer::create(scene, target);
    target.specialise = options.allowed_difference ? glsl::Specialise::constants : glsl::Specialise::settled;
    auto trial = choose_program(scene, target, plan_trial(scene, options, plan.frames));
    if (!trial)
        return fail(std::move(trial.error()));
    if (!trial->said.empty())
        say(trial->said);
    return std::move(trial->renderer);
}

Result<render::Renderer> compile(const scene::Scene& scene, const CaptureOptions& options,
                                 const CapturePlan& plan, Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    Watchdog watchdog;
    const Watchdog::Watch watch(watchdog, "compiling", plan.timeout);
    const SampleType samples = plan.depth == SampleDepth::u8 ? SampleType::u8 : SampleType::f32;
    const auto tile = choose_tile(options, plan, samples);
    if (!tile)
        return fail(tile.error());
    auto renderer = choose_renderer(
        scene, options, plan,
        {.extent = plan.frames.extent,
         .samples = samples,
         .pass = options.frames.pass,
         .precision = precision_of(options.scene),
         .specialise = options.plain ? glsl::Specialise::nothing : glsl::Specialise::unreachable,
         .tile = *tile,
         .marks_non_finite = true});
    if (renderer && options.tile && !renderer->tiles())
        return fail(
            ErrorCode::usage,
            fmt::format(
                "--tile: {} must be drawn whole: it is a cube, a pass reads it, or it discards pixels",
                renderer->shown_pass().name));
    return renderer;
}

void say_what_was_written(const std::vector<FrameRecord>& records, const CapturePlan& plan) {
    if (plan.output.video())
        say(fmt::format(
            "wrote {}: {} frames{}", records.front().file, records.size(),
            plan.video_fps == plan.frames.fps ? "" : fmt::format(", {:.4g} a second", plan.video_fps)));
    else if (records.size() == 1)
        say(fmt::format("wrote {}", records.front().file));
    else if (!records.empty())
        say(fmt::format("wrote {} frames, {} to {}", records.size(), records.front().file,
                        records.back().file));
}

/// One line for all frames: a file does not show what was no number.
void say_what_is_not_finite(const CaptureOptions& options, const std::vector<FrameRecord>& records) {
    const auto bad = [](const FrameRecord& record) { return record.not_finite > 0; };
    const auto first = std::ranges::find_if(records, bad);
    if (first == records.end())
        return;
    const auto others = std::ranges::count_if(first + 1, records.end(), bad);
    say(fmt::format("warning: {} not finite{}; where from: {}",
                    pixels_are(first->not_finite, fmt::format("of frame {}", first->frame)),
                    others > 0 ? fmt::format(" (and of {} other frame{})", others, others > 1 ? "s" : "")
                               : "",
                    trace_command(options.scene, options.frames, first->frame)));
}

/// `-o x.wav` asks for the sound of a scene instead of its pictures.
bool wants_sound(const CaptureOptions& options) {
    return options.output && std::filesystem::path(*options.output).extension() == ".wav";
}

/// What the scene plays during the frames of a video. Pictures without it are better than none: what is wrong
/// is said, and nothing else.
std::optional<StagedFile> draw_sound_of_video(const scene::Scene& scene, glsl::Precision precision,
                                              const CapturePlan& plan, const Interrupt& interrupt) {
    if (!plan.output.video())
        return std::nullopt;
    const std::vector<int>& frames = plan.frames.frames;
    const VideoPace pace = pace_of(frames, plan.frames.fps);
    const bool heard =
        plan.output.pattern().extension() != ".gif" && scene.find(scene::PassKind::sound) != nullptr;
    if (!pace.not_in_time.empty())
        say(fmt::format("the video does not go by the scene's time: {}, {:.4g} a second{}", pace.not_in_time,
                        pace.fps, heard ? "; it is silent" : ""));
    if (!heard || !pace.not_in_time.empty())
        return std::nullopt;
    const auto first = inputs_of(plan.frames, frames.front()).time;
    auto samples =
        draw_sound(scene, precision, std::max(0.0, first), double(frames.size()) / pace.fps, interrupt);
    auto file = StagedFile::create(plan.output.of_frame(0), ".wav");
    Result<void> written = !file      ? fail(std::move(file.error()))
                           : !samples ? fail(std::move(samples.error()))
                                      : sound::write_wav(file->path(), int(render::k_sample_rate), *samples);
    if (written)
        return *std::move(file);
    say("the video is silent: " + to_string(written.error()));
    return std::nullopt;
}

Result<int> capture(const CaptureOptions& options) {
    if (wants_sound(options))
        return capture_sound(options.scene, {*options.output, options.device, options.duration});
    auto plan = plan_capture(options);
    if (!plan)
        return fail(plan.error());
    if (options.json && plan->output.standard_output())
        return fail(ErrorCode::usage, "--json and -o - both want standard output: give one of them");
    Interrupt interrupt;
    std::jthread codec; // is loaded beside the driver, which takes as long
    if (!plan->output.standard_output() && !plan->output.video())
        codec = image::preload_picture_codec(plan->output.pattern());
    auto scene = load(options.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    if (auto spared = spare_what_is_read(*scene, options, *plan); !spared)
        return fail(std::move(spared.error()));
    const auto context = platform::HeadlessContext::create(options.device);
    if (!context)
        return fail(context.error());
    const std::optional<StagedFile> sound =
        draw_sound_of_video(*scene, precision_of(options.scene), *plan, interrupt);
    auto renderer = compile(*scene, options, *plan, interrupt);
    if (!renderer)
        return fail(std::move(renderer.error()));
    Capture run(*plan, *renderer, sound ? sound->path() : std::filesystem::path());
    const auto complete = run.run(interrupt);
    if (!complete)
        return fail(complete.error());
    if (options.json)
        if (auto printed = put(dump(run.report(), 2) + "\n"); !printed)
            return fail(std::move(printed.error()));
    say_what_is_not_finite(options, run.records());
    const bool written = *complete || !plan->output.video(); // of a video nothing is kept but the whole
    if (written && !options.json && !plan->output.standard_output())
        say_what_was_written(run.records(), *plan);
    if (!*complete)
        say(fmt::format("interrupted after {} of {} frames{}", run.records().size(),
                        plan->frames.frames.size(), written ? "" : ": no video was written"));
    return *complete ? 0 : Interrupt::k_exit_code;
}

} // namespace

void add_capture(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<CaptureOptions>();
    CLI::App* command =
        app.add_subcommand("capture", "Makes pictures, raw frames or a video of a scene, with no display");
    add_scene_options(*command, options->scene);
    add_precision_options(*command, options->scene);
    add_picture_options(*command, options->frames);
    add_time_options(*command, options->frames);
    command
        ->add_option("-o,--output", options->output,
                     "File: .png .jpg .tif .exr .hdr, a sequence with %04d or ####; {} for the six faces of "
                     "a cube; a video: .mp4 .webm .gif; - for "
                     "raw RGB frames on standard output [SCENE.png]")
        ->type_name("OUT");
    command
        ->add_option(
            "--depth", options->depth,
            "Bits of a sample in the file [what the format stores by nature; a --pass in .exr: float]")
        ->type_name("8|16|half|float");
    command
        ->add_option("--device", options->device, "Where to draw: a name from `tidemark inspect --devices`")
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("--timeout", options->timeout,
                     "Give up where compiling takes longer, or getting ready to draw, or a frame")
        ->type_name("SECONDS")
        ->check(number<double>("a number of seconds"));
    command->add_option("--duration", options->duration, "Length of a .wav")
        ->type_name("SECONDS")
        ->check(number<double>("a number of seconds"))
        ->capture_default_str();
    auto* plain = command->add_flag("--plain", options->plain, "Compiles the scene's text whole, as it is");
    command
        ->add_option("--allow-difference", options->allowed_difference,
                     "Makes knobs constants where that is faster and moves no sample by more")
        ->type_name("MAX")
        ->check(number<double>("a number"))
        ->excludes(plain)
        ->excludes("--timeout"); // a trial's frames have no limit
    command
        ->add_option("--tile", options->tile,
                     "Draw in tiles of N pixels a side, an even number [1024x256 above 4096x2160 pixels]")
        ->type_name("N")
        ->check(number<int>("a whole number"));
    command->add_flag("--json", options->json, "One JSON object about the frames on standard output");
    command->callback([options, &chosen] { chosen = [options] { return capture(*options); }; });
}

} // namespace tidemark::cli
