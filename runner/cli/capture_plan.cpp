#include "cli/capture_plan.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/capture_delivery.hpp"
#include "cli/capture_resume.hpp"
#include "host/console.hpp"
#include "host/scene_report.hpp"
#include "media/texture_files.hpp"
#include "media/video_output.hpp"
#include "render/picture_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_set>

namespace tidemark::cli {

using namespace host;
using host::resolve;
namespace {

using image::Alpha;
using image::SampleDepth;
using image::SampleType;
using image::Transfer;

/// Returns a function that makes the error `OPTION: why`.
auto refusal(std::string option) {
    return [option = std::move(option)](std::string_view why) {
        return fail(ErrorCode::usage, fmt::format("{}: {}", option, why));
    };
}

/// Keeps floats for passes other than Image: a buffer is state, and a half float would turn 1e6 into
/// infinity.
SampleDepth default_depth(const OutputName& output, const std::string& pass) {
    const SampleDepth natural = image::natural_depth(output.pattern());
    const bool state = drawn_transfer(pass) == Transfer::data;
    return natural == SampleDepth::half && state ? SampleDepth::f32 : natural;
}

/// Returns 16 bits for a video of ten bits; frames are drawn in that depth.
Result<SampleDepth> parse_depth(const std::string& text, const OutputName& output, const std::string& codec,
                                const std::string& pass) {
    constexpr std::pair<std::string_view, SampleDepth> k_depths[] = {{"8", SampleDepth::u8},
                                                                     {"16", SampleDepth::u16},
                                                                     {"half", SampleDepth::half},
                                                                     {"float", SampleDepth::f32}};
    const bool raw = output.standard_output() || output.video();
    if (raw && !text.empty())
        return fail(ErrorCode::usage, "--depth: is for picture files only; raw frames have 8 bits, the depth "
                                      "of a video follows from --codec");
    if (text.empty() && raw)
        return output.video() && image::has_ten_bits(output.pattern(), codec) ? SampleDepth::u16
                                                                              : SampleDepth::u8;
    if (text.empty())
        return default_depth(output, pass);
    for (const auto& [name, depth] : k_depths)
        if (name == text)
            return depth;
    return fail(ErrorCode::usage, fmt::format("--depth {}: give 8, 16, half or float", text));
}

Result<Transfer> parse_transfer(const std::string& text, const CapturePlan& plan) {
    const auto refuse = refusal("--transfer " + text);
    if (text.empty())
        return drawn_transfer(plan.frames.state.pass);
    if (text == "srgb")
        return Transfer::srgb;
    if (text != "linear")
        return refuse("give srgb or linear");
    if (!plan.to_picture_files())
        return refuse("videos and raw frames on standard output are always sRGB");
    if (plan.encoding.depth == SampleDepth::u8)
        return refuse("8 bits of linear light show steps in dark areas: give --depth 16, or an .exr");
    return Transfer::linear;
}

/// Returns how Image's alpha is drawn and stored in the file.
Result<Alpha> parse_alpha(const std::string& text, const CapturePlan& plan) {
    const auto refuse = refusal("--alpha " + text);
    if (text.empty() || text == "opaque")
        return Alpha::where_needed;
    if (text != "keep" && text != "premultiplied")
        return refuse("give opaque, keep or premultiplied");
    const Alpha alpha = text == "keep" ? Alpha::straight : Alpha::premultiplied;
    const auto holds = [&](Alpha kind) {
        const std::filesystem::path& name = plan.output.pattern();
        return plan.output.video() ? image::video_holds_alpha(name, plan.video.codec, kind)
                                   : image::holds_alpha(name, kind);
    };
    if (drawn_transfer(plan.frames.state.pass) == Transfer::data)
        return refuse(
            "only Image has an alpha to convert; the file of another pass has all four channels unchanged");
    if (plan.output.standard_output() || !holds(Alpha::straight))
        return refuse("this output has no alpha: give a .png, .tif, .exr, .mov, .webm or .webp");
    if (!holds(alpha))
        return refuse(fmt::format("{} stores straight alpha: give --alpha keep, or write .tif, .exr or .mov",
                                  plan.output.pattern().extension().string()));
    return alpha;
}

/// Returns the sample depth of the passes written in addition to Image. Buffers are state, so they keep
/// floats by default.
Result<std::optional<SampleDepth>> parse_layers(const CaptureOptions& options, const CapturePlan& plan) {
    const auto refuse = refusal("--layers");
    if (!options.encoding.layers)
        return std::nullopt;
    if (!plan.to_picture_files() || !image::holds_layers(plan.output.pattern()))
        return refuse("only an .exr can hold several pictures");
    if (plan.output.six_faces())
        return refuse("the faces of a cube become layers: remove {} from the name");
    if (!plan.frames.state.pass.empty())
        return refuse("the file holds all passes: remove --pass");
    if (options.drawing.tile)
        return refuse("passes are not drawn in tiles: remove --tile");
    if (plan.drawing.exposure.shutter > 0)
        return refuse("not with --shutter: a frame then has several moments, and buffers cannot be averaged");
    const Extent extent = plan.frames.state.extent;
    if (std::max(extent.width, extent.height) > image::k_largest_side)
        return refuse(fmt::format("a side has at most {} pixels", image::k_largest_side));
    return options.encoding.depth.empty() ? SampleDepth::f32 : plan.encoding.depth;
}

/// Returns the part of a picture of size `drawn` that is written; nothing for the whole picture.
Result<std::optional<Rectangle>> parse_crop(const CaptureOptions& options, const CapturePlan& plan,
                                            Extent drawn) {
    if (!options.crop)
        return std::nullopt;
    const auto refuse = refusal("--crop " + *options.crop);
    const auto area = parse_rectangle(*options.crop);
    if (!area)
        return refuse("give X,Y,WIDTH,HEIGHT in pixels from the bottom left, as in 100,50,320,180");
    if (plan.output.six_faces())
        return refuse("the faces of a cube are written whole: leave {} out of the name");
    const auto& [x, y, size] = *area;
    if (x < 0 || y < 0 || size.width > drawn.width - x || size.height > drawn.height - y)
        return refuse(fmt::format("the rectangle is not inside the picture of {}x{} pixels", drawn.width,
                                  drawn.height));
    return size == drawn ? std::nullopt : std::optional(*area);
}

/// The default length of a sheet in seconds.
constexpr double k_seconds_of_sheet = 10;

/// Returns the frames of the sheet's cells.
Result<std::vector<int>> frames_of_sheet(const CaptureOptions& options, const FrameSequence& asked,
                                         const SheetGrid& grid) {
    const auto refuse = refusal("--sheet");
    if (options.frames.frame || options.frames.time)
        return refuse("--frame and --time name one moment: give --frames or --duration");
    if (options.frames.frames && options.time.given())
        return refuse("give either --frames or --duration");
    if (options.frames.frames)
        return asked.frames.size() >= grid.cells()
                   ? Result<std::vector<int>>(evenly(asked.frames, grid.cells()))
                   : refuse(fmt::format("{}x{} cells need {} frames, but --frames names {}", grid.columns,
                                        grid.rows, grid.cells(), asked.frames.size()));
    const TimePart part = TRY(part_of(options.time, k_seconds_of_sheet));
    const double frames = part.length * asked.state.fps;
    if (!(frames >= double(grid.cells())) || frames + part.begin * asked.state.fps > render::k_last_frame)
        return refuse(fmt::format("{} s at {} frames per second cannot give {} moments", part.length,
                                  asked.state.fps, grid.cells()));
    return beginnings(part, asked.state.fps, grid.cells());
}

/// Rejects outputs that do not fit a sheet.
Result<void> check_sheet(const CapturePlan& plan) {
    if (!plan.area.sheet)
        return {};
    const auto refuse = refusal("--sheet");
    if (!plan.to_picture_files() || plan.output.six_faces())
        return refuse("the sheet is one picture: give a .png, .jpg, .tif, .exr or .hdr");
    if (plan.area.cube && !plan.area.crop)
        return refuse("a cube is shown as a panorama, which is too large for a cell");
    const Extent extent = plan.area.sheet->extent(plan.area.written);
    const size_t bytes = extent.pixels() * 4 * image::size_of(plan.drawing.options.samples);
    if (std::max(extent.width, extent.height) > image::k_largest_side || bytes > image::k_largest_picture)
        return refuse(fmt::format("the sheet would have {}x{} pixels: give a smaller --size, or fewer cells",
                                  extent.width, extent.height));
    return {};
}

/// Returns the options with the frames of --from, --to and --duration, which a sheet reads itself.
Result<FrameOptions> with_time(const CaptureOptions& options, FrameOptions frames) {
    if (!options.time.given() || !options.sheet.empty())
        return frames;
    if (frames.frame || frames.frames || frames.time)
        return fail(ErrorCode::usage,
                    fmt::format("{}: --from, --to and --duration select the frames already; "
                                "give only one of them",
                                frames.frame    ? "--frame"
                                : frames.frames ? "--frames"
                                                : "--time"));
    const FrameSequence base = options.like.frames.value_or(FrameSequence());
    const auto typed = frames.numbers.find("--fps");
    const double fps =
        typed != frames.numbers.end() ? typed->second : base.lead_in_fps.value_or(base.state.fps);
    if (!(fps > 0) || !std::isfinite(fps))
        return frames; // `resolve` refuses it
    const TimePart part = TRY(part_of(options.time));
    frames.frames = TRY(frames_in(part, fps));
    return frames;
}

/// Fails if a video is requested without its frames, which would be a video of one frame.
Result<void> check_frames_of_video(const CapturePlan& plan, const CaptureOptions& options) {
    const FrameOptions& frames = options.frames;
    if (!plan.output.video() || options.time.given() || frames.frame || frames.frames || frames.time)
        return {};
    return fail(ErrorCode::usage,
                fmt::format("-o {}: give the length of the video, as in --duration 5, --from 2 --to 4.5 or "
                            "--frames 0-299",
                            plan.output.pattern().string()));
}

/// Sets the size of the written pictures after --pad.
Result<void> pad(const std::string& text, CapturePlan& plan) {
    if (text.empty())
        return {};
    if (!plan.output.video())
        return fail(ErrorCode::usage,
                    "--pad: is for videos only; pictures and raw frames may have odd sides");
    const Extent even{plan.area.written.width + plan.area.written.width % 2,
                      plan.area.written.height + plan.area.written.height % 2};
    plan.area.padded = even != plan.area.written;
    plan.area.written = even;
    return {};
}

/// Removes repeated frames (`0-9,5-14`): each frame is one file.
void drop_repeats(std::vector<int>& frames) {
    std::unordered_set<int> seen;
    std::erase_if(frames, [&](int frame) { return !seen.insert(frame).second; });
}

/// In seconds. A WAV file of 16-bit stereo counts its bytes in 32 bits, which allows some six hours; this
/// limit is lower.
constexpr double k_longest_sound = 3600;
constexpr double k_seconds_of_sound = 60;

/// Fails if existing and missing frames could not be distinguished.
Result<void> check_resume(const OutputName& output) {
    const auto refuse = refusal("--resume");
    if (output.standard_output())
        return refuse("frames on standard output cannot be resumed");
    if (!output.video() && !image::holds_metadata(output.pattern()))
        return refuse(fmt::format("a {} cannot record how it was drawn: give a .png, .jpg, .tif or .exr",
                                  output.pattern().extension().string()));
    return {};
}

/// Fails if several processes could not write to one folder, or `gather` could not check the result.
Result<void> check_shard(const CaptureOptions& options, const OutputName& output) {
    const auto refuse = refusal("--shard");
    if (output.standard_output())
        return refuse(
            "write files (a sequence of pictures or a video), so that `tidemark gather` can read them");
    if (!output.video() && !image::holds_metadata(output.pattern()))
        return check_resume(output);
    if (options.drawing.allowed_difference)
        return refuse("not with --allow-difference, which may choose another program on each machine");
    return {};
}

/// Checks the options that keep data for a later run.
Result<void> check_keeping(const CaptureOptions& options, const OutputName& output, Extent extent) {
    if (options.run.resume)
        TRY(check_resume(output));
    if (options.run.state_every > 0 && output.standard_output())
        return fail(ErrorCode::usage, "--state-every: frames on standard output cannot be resumed");
    if (options.run.state_every > 0 && extent.pixels() * 4 * sizeof(float) > k_largest_saved_buffer)
        return fail(ErrorCode::usage, fmt::format("--state-every: buffers of {}x{} are too large to save",
                                                  extent.width, extent.height));
    if (!options.run.shard.empty())
        TRY(check_shard(options, output));
    return {};
}

/// Motion blur and smooth edges are seldom wanted one without the other, so --shutter alone implies several
/// samples.
constexpr int k_samples_of_shutter = 16;

/// Clamps each sample for integer formats, as a display does.
render::Exposure exposure_of(const CaptureOptions& options, SampleDepth depth) {
    const double shutter = options.drawing.shutter.value_or(0);
    return {.samples = options.drawing.samples.value_or(shutter > 0 ? k_samples_of_shutter : 1),
            .shutter = shutter,
            .clamped = depth == SampleDepth::u8 || depth == SampleDepth::u16};
}

/// Checks that the output format can hold the frames.
Result<void> check_output(const CapturePlan& plan, const CaptureOptions& options) {
    const OutputName& output = plan.output;
    const Extent extent = plan.frames.state.extent;
    if (output.video() && output.pattern().extension() == ".gif" &&
        plan.video.pace.fps > image::k_fastest_gif)
        return fail(ErrorCode::usage, fmt::format("--fps {}: a GIF has at most {} frames per second",
                                                  plan.frames.state.fps, image::k_fastest_gif));
    if (plan.to_picture_files()) {
        TRY(image::check_picture_format(output.pattern(), plan.encoding.depth));
        TRY(image::PictureStream::check_extent(output.pattern(), plan.area.written));
    }
    TRY(check_sheet(plan));
    TRY(check_keeping(options, output, extent));
    if (options.run.loop && plan.frames.frames.size() < 2)
        return fail(ErrorCode::usage, "--loop: give at least two --frames");
    if (options.drawing.tile && output.video())
        return fail(ErrorCode::usage, "--tile: the frames of a video are not drawn in tiles");
    if (options.run.timeout && !(*options.run.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    if (options.run.json && output.standard_output())
        return fail(ErrorCode::usage, "--json and -o - both write to standard output: give one of them");
    if (std::max(extent.width, extent.height) > render::k_largest_tiled_side)
        return fail(ErrorCode::usage, fmt::format("--size {}x{}: a side has at most {} pixels", extent.width,
                                                  extent.height, render::k_largest_tiled_side));
    return check_frames_of_video(plan, options);
}

/// Returns the pass that a command shows; null if the scene has none of that name.
const scene::Pass* shown_pass(const scene::Scene& scene, const std::string& name) {
    const auto shown =
        std::ranges::find(scene.passes, name.empty() ? scene.image().name : name, &scene::Pass::name);
    return shown == scene.passes.end() ? nullptr : &*shown;
}

/// Converts the options. `files` is the scene without the changes that options make to it, which gives the
/// size and the kind of the shown pass; null if it could not be loaded.
Result<CapturePlan> plan_of_options(const CaptureOptions& options, const scene::Scene* files) {
    CapturePlan plan;
    plan.options = options;
    FrameOptions frames = TRY(with_time(options, options.frames));
    if (files && !options.like.frames)
        frames = sized(std::move(frames), *files);
    plan.frames = TRY(resolve(frames, options.like.frames.value_or(FrameSequence())));
    plan.states = states_of(plan.frames);
    const scene::Pass* const shown = files ? shown_pass(*files, plan.frames.state.pass) : nullptr;
    plan.area.cube = shown && shown->kind == scene::PassKind::cubemap;
    std::vector<int>& numbers = plan.frames.frames;
    if (!options.sheet.empty()) {
        plan.area.sheet = TRY(parse_sheet(options.sheet));
        numbers = TRY(frames_of_sheet(options, plan.frames, *plan.area.sheet));
    }
    const size_t count = plan.area.sheet ? 1 : std::unordered_set(numbers.begin(), numbers.end()).size();
    plan.output = TRY(options.output ? OutputName::parse(*options.output, count)
                                     : OutputName::of_scene(options.scene.path, count));
    if (plan.to_picture_files() && !plan.area.sheet)
        drop_repeats(numbers);
    plan.video.codec = TRY(parse_codec(options.encoding.codec, plan.output));
    plan.encoding.depth =
        TRY(parse_depth(options.encoding.depth, plan.output, plan.video.codec, plan.frames.state.pass));
    plan.encoding.transfer = TRY(parse_transfer(options.encoding.transfer, plan));
    plan.video.pace = pace_of(numbers, plan.frames.state.fps);
    plan.drawing.exposure = exposure_of(options, plan.encoding.depth);
    plan.encoding.alpha = TRY(parse_alpha(options.encoding.alpha, plan));
    plan.encoding.layers = TRY(parse_layers(options, plan));
    const Extent drawn = plan.area.cube ? image::k_panorama : plan.frames.state.extent;
    plan.area.crop = TRY(parse_crop(options, plan, drawn));
    plan.area.written = plan.area.crop ? plan.area.crop->extent : drawn;
    TRY(plan_lens_output(plan));
    TRY(pad(options.encoding.pad, plan));
    const bool bytes = plan.encoding.depth == SampleDepth::u8 && !plan.drawing.exposure.several() &&
                       !plan.keeps_alpha() && options.lens.empty();
    plan.drawing.options = {
        .extent = plan.frames.state.extent,
        .samples = bytes ? SampleType::u8 : SampleType::f32,
        .pass = plan.frames.state.pass,
        .precision = precision_of(options.scene),
        .specialise = options.drawing.plain ? glsl::Specialise::nothing : glsl::Specialise::unreachable,
        .extras = {.passes = options.encoding.layers},
        .marks_non_finite = true,
        .keeps_alpha = plan.keeps_alpha(),
    };
    if (plan.output.video())
        plan.video.segments = segments_of(numbers, plan.video.pace, options.run.state_every);
    return check_output(plan, options).map([&] { return std::move(plan); });
}

/// Makes the folders of the output that do not exist.
Result<void> make_folders(const CapturePlan& plan) {
    const auto folder_of = [&](int frame) { return plan.output.of_frame(frame).path().parent_path(); };
    const std::vector<int>& frames = plan.frames.frames;
    std::error_code ignored;
    const bool several = folder_of(frames.front()) != folder_of(frames.back()); // a number in its name
    for (const int frame : several ? std::span(frames) : std::span(frames).first(1))
        if (const std::filesystem::path folder = folder_of(frame);
            !folder.empty() && !std::filesystem::exists(folder, ignored)) {
            TRY(plan.output.of_frame(frame).check_links());
            TRY(make_folder(OutputPath::typed(folder)));
        }
    return {};
}

/// Refuses to overwrite a file that is read, also for a late frame of a sequence, before the first frame is
/// drawn.
Result<void> spare_what_is_read(const CaptureOptions& options, CapturePlan& plan) {
    std::vector<std::filesystem::path> read = files_read(plan.scene, options.frames);
    if (!options.like.picture.empty())
        read.emplace_back(options.like.picture);
    if (plan.output.standard_output())
        return {};
    plan.output.spare(read);
    TRY(make_folders(plan));
    TRY(check_writable(plan.output.of_frame(plan.frames.frames.front())));
    for (const std::filesystem::path& file : read)
        if (const auto frame = frame_of(file, plan.output);
            frame && std::ranges::find(plan.frames.frames, *frame) != plan.frames.frames.end())
            TRY(plan.output.of_frame(*frame).place());
    return {};
}

Result<void> check_six_faces(const CapturePlan& plan) {
    if (plan.output.six_faces() && !plan.area.cube && shown_pass(plan.scene, plan.drawing.options.pass))
        return fail(ErrorCode::usage,
                    fmt::format("-o {}: {{}} in the name stands for a face of a cube: give --pass \"Cube A\"",
                                plan.output.pattern().string()));
    return {};
}

/// With fewer frames a trial of another program does not pay.
constexpr size_t k_frames_worth_a_trial = 64;

/// Plans a trial of the first and the last frame, in their states of the sequence but with empty buffers.
/// While a recording changes knobs, they cannot be constants in a program.
Result<std::optional<TrialPlan>> plan_trial(const CaptureOptions& options, const CapturePlan& plan) {
    const std::vector<int>& frames = plan.frames.frames;
    const bool turned = plan.frames.input && turns_knobs(*plan.frames.input);
    if (turned && options.drawing.allowed_difference)
        return fail(ErrorCode::usage,
                    fmt::format("--allow-difference: knobs cannot be constants, because {} changes them",
                                plan.frames.input_file));
    const bool long_enough = frames.size() >= k_frames_worth_a_trial && !options.run.timeout;
    if (options.drawing.plain || plan.drawing.lens || turned ||
        !(options.drawing.allowed_difference || long_enough))
        return std::nullopt;
    const int first = plan.scene.passes.size() > 1 ? 0 : frames.front(); // buffers begin at frame 0
    return TrialPlan{inputs_of(plan.states(first)), inputs_of(plan.states(frames.back())), frames.size(),
                     options.drawing.allowed_difference};
}

/// Assigns whole segments of a video to the shard, since segments are encoded separately.
void take_segments(const Shard& shard, CapturePlan& plan) {
    for (VideoSegment& segment : plan.video.segments)
        segment.others = true;
    plan.frames.frames.clear();
    for (const size_t index : segments_of_shard(shard, plan.video.segments.size(), plan.scene)) {
        VideoSegment& own = plan.video.segments[index];
        own.others = false;
        plan.frames.frames.insert(plan.frames.frames.end(), own.frames.begin(), own.frames.end());
    }
}

/// Reduces the plan to the shard's frames. All shards draw the same program, without a trial.
Result<void> take_shard(const CaptureOptions& options, CapturePlan& plan) {
    plan.shard = TRY(parse_shard(options.run.shard));
    const std::filesystem::path folder = plan.output.of_frame(0).path().parent_path();
    TRY(leave_note(OutputPath::typed(folder.empty() ? "." : folder) / k_shard_note,
                   {options.run.words, plan.shard->count}));
    if (plan.output.video())
        take_segments(*plan.shard, plan);
    else
        plan.frames.frames = frames_of(*plan.shard, plan.frames.frames, plan.scene);
    return {};
}

host::DeviceChoice device_of(const RunOptions& run) {
    host::DeviceChoice device = run.device;
    if (run.es)
        device.name = host::with_es(device.name);
    return device;
}

} // namespace

Result<CapturePlan> plan_capture(const CaptureOptions& options) {
    // Wrong options are reported before a scene that cannot be loaded.
    auto files = scene::load_scene(options.scene.path, options.scene.files);
    CapturePlan plan = TRY(plan_of_options(options, files ? &*files : nullptr));
    plan.options.run.device = device_of(options.run);
    plan.scene = TRY(load(options.scene, plan.frames, std::move(files)));
    TRY(plan_lens(plan));
    TRY(spare_what_is_read(options, plan));
    TRY(check_six_faces(plan));
    TRY(parse_audio(options.encoding.audio, plan.output.pattern(), plan.scene));
    if (options.run.shard.empty())
        plan.drawing.trial = TRY(plan_trial(options, plan));
    plan.identity = identity_of_run(plan);
    if (!options.run.shard.empty())
        TRY(take_shard(options, plan));
    return plan;
}

Result<std::string> parse_codec(const std::string& text, const OutputName& output) {
    if (text.empty())
        return text;
    const auto codecs = output.video() ? image::codecs_of(output.pattern()) : std::vector<std::string_view>();
    if (codecs.empty())
        return fail(ErrorCode::usage, fmt::format("--codec {}: give an .mp4, an .mkv or a .webm", text));
    if (std::ranges::find(codecs, text) == codecs.end())
        return fail(ErrorCode::usage,
                    fmt::format("--codec {}: a {} holds {}", text, output.pattern().extension().string(),
                                fmt::join(codecs, ", ")));
    return text;
}

Transfer drawn_transfer(const std::string& pass) {
    return pass.empty() || pass == "Image" ? Transfer::srgb : Transfer::data;
}

bool can_be_resumed(const CapturePlan& plan) {
    return !plan.area.sheet && check_resume(plan.output).has_value();
}

std::string words_on_resuming(const CapturePlan& plan, size_t whole_frames) {
    if (whole_frames == 0 || !can_be_resumed(plan))
        return {};
    return fmt::format("{} frame{} complete; to continue, run the same command with --resume", whole_frames,
                       whole_frames == 1 ? " is" : "s are");
}

bool wants_sound(const CaptureOptions& options) {
    return options.output && std::filesystem::path(*options.output).extension() == ".wav";
}

Result<SoundPlan> plan_sound(const CaptureOptions& options) {
    if (options.run.resume)
        return fail(ErrorCode::usage, "--resume: a sound cannot be resumed");
    if (!options.time.to && options.time.duration.value_or(1) <= 0)
        return fail(ErrorCode::usage, fmt::format("--duration {}: give more than 0 and at most {} seconds",
                                                  *options.time.duration, k_longest_sound));
    const TimePart part = TRY(part_of(options.time, k_seconds_of_sound));
    if (part.length > k_longest_sound)
        return fail(ErrorCode::usage, fmt::format("--duration {}: give more than 0 and at most {} seconds",
                                                  part.length, k_longest_sound));
    auto scene = TRY(load(options.scene));
    OutputPath output = OutputPath::typed(*options.output).sparing(files_read(scene));
    if (const auto folder = output.path().parent_path(); !folder.empty())
        TRY(make_folder(OutputPath::typed(folder)));
    TRY(check_writable(output));
    const auto heard = TRY(parse_audio(options.encoding.audio, *options.output, scene));
    return SoundPlan{std::move(scene),
                     std::move(output),
                     device_of(options.run),
                     precision_of(options.scene),
                     part,
                     heard};
}

} // namespace tidemark::cli
