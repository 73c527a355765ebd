// Checks the output of a capture's shards against their common plan: whether every frame exists, is complete,
// and was drawn by one program on one kind of device, and whether this machine draws the same. Then makes a
// video of it on request.

#include "base/error.hpp"
#include "base/folders.hpp"
#include "cli/capture_delivery.hpp"
#include "cli/capture_frames.hpp"
#include "cli/capture_plan.hpp"
#include "cli/capture_resume.hpp"
#include "cli/capture_run.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/fingerprint.hpp"
#include "host/gl_context.hpp"
#include "host/moment.hpp"
#include "host/scene_report.hpp"
#include "media/file_samples.hpp"
#include "media/picture_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;
namespace {

struct Gathered {
    std::vector<std::string> wrong;          ///< messages, one line each
    std::map<std::string, size_t> devices{}; ///< devices that drew frames, and their number of frames
    bool drawn_here = true;                  ///< by a device like this machine's
};

struct GatherOptions {
    std::filesystem::path folder;
    std::optional<std::string> video;
    std::string codec{};          ///< of the video; empty: the default of its file type
    int samples = 3;              ///< frames that are drawn again for comparison
    double tolerance = 2.0 / 255; ///< of a sample, if another device drew the frames
};

/// Returns the problem of a picture or a segment of a video; empty if there is none.
std::string look_at(const fs::path& file, bool segment, const Fingerprint& wanted, Gathered& gathered) {
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        return "missing";
    std::string text, device;
    if (segment) {
        const auto note = image::note_of_segment(file);
        if (!note)
            return "incomplete";
        text = *note;
    } else {
        const auto metadata = image::read_metadata(file);
        if (!metadata)
            return "incomplete: " + metadata.error();
        const std::string* fingerprint = image::find(*metadata, k_fingerprint);
        if (!fingerprint)
            return "no fingerprint";
        text = *fingerprint;
        const std::string* driver = image::find(*metadata, "Driver");
        device = driver ? *driver : "an unknown device";
    }
    const Fingerprint found = Fingerprint::parse(text);
    const bool here = wanted.on_device_of(found) == wanted;
    if (segment)
        device = here ? "this device" : fmt::format("device {}", found.device());
    ++gathered.devices[device];
    gathered.drawn_here &= here;
    const std::string others = wanted.on_device_of(found).differences(found);
    return others.empty() ? "" : "drawn with " + others;
}

/// Returns the files of a frame; for a video, `piece` is the index of a segment.
std::vector<fs::path> files_of_piece(const CapturePlan& plan, int piece) {
    return plan.output.video() ? std::vector{segment_file(plan.output, size_t(piece)).path()}
                               : files_of(plan.output, piece);
}

/// Returns the number of the shard that makes this file.
int shard_of(const CapturePlan& plan, int shards, const std::string& file) {
    for (int index = 0; index < shards; ++index)
        for (const int piece :
             plan.output.video() ? segments_of_shard({index, shards}, plan.video.segments.size(), plan.scene)
                                 : frames_of({index, shards}, plan.frames.frames, plan.scene))
            for (const fs::path& made : files_of_piece(plan, piece))
                if (made.string() == file)
                    return index + 1;
    return 0;
}

/// Checks the whole plan, not one shard. The plan's identity is that of this machine.
Gathered gathered(const CapturePlan& plan, int shards) {
    const bool video = plan.output.video();
    const std::string_view pieces = video ? "segments" : "frames";
    const size_t total = video ? plan.video.segments.size() : plan.frames.frames.size();
    Gathered result;
    std::vector<Wrong> all;
    Progress progress(fmt::format("{} checked", pieces), total);
    for (size_t i = 0; i < total; ++i, progress.advance()) {
        const Fingerprint wanted = video ? Fingerprint::parse(note_of(plan, plan.video.segments[i]))
                                         : plan.identity_of(plan.frames.frames[i]);
        for (const fs::path& file : files_of_piece(plan, video ? int(i) : plan.frames.frames[i]))
            if (auto what = look_at(file, video, wanted, result); !what.empty())
                note(all, std::move(what), file.string());
    }
    for (const auto& [what, first, count] : all)
        result.wrong.push_back(fmt::format("{} of {} {}: {}; the first is {} (shard {}/{})", count, total,
                                           pieces, what, first, shard_of(plan, shards, first), shards));
    std::error_code ignored;
    if (video && result.devices.empty() && fs::exists(plan.output.pattern(), ignored))
        result.wrong.push_back(
            fmt::format("{} exists, but none of its segments; if it was joined before, nothing is left to do",
                        plan.output.pattern().string()));
    if (result.devices.size() > 1)
        for (const auto& [device, count] : result.devices)
            result.wrong.push_back(fmt::format("{} {} were drawn by {}", count, pieces, device));
    return result;
}

Result<CaptureOptions> options_of(const ShardNote& note, const fs::path& file) {
    CaptureOptions options;
    if (auto parsed =
            parse_words([&](Command command) { add_capture_options(command, options); }, note.words);
        !parsed)
        return fail(ErrorCode::load, fmt::format("'{}': {}", file.string(), parsed.error().message));
    return options;
}

/// Returns the plan that all shards share.
Result<CapturePlan> shared_plan(const GatherOptions& options, const ShardNote& note) {
    const fs::path file = options.folder / k_shard_note;
    const CaptureOptions capture = TRY(options_of(note, file).and_then(with_likeness));
    CapturePlan plan = TRY(plan_capture(capture));
    std::error_code ignored;
    const fs::path folder = plan.output.of_frame(0).path().parent_path();
    if (!fs::equivalent(folder.empty() ? "." : folder, options.folder, ignored))
        return fail(
            ErrorCode::usage,
            fmt::format("'{}' was written for '{}': run gather in the folder from which the shards were run",
                        file.string(), plan.output.pattern().string()));
    plan.output.came_from_a_file();
    plan.drawing.trial.reset(); // shards make none
    return plan;
}

/// Selects frames evenly; if frames may depend on earlier ones, only the first.
std::vector<int> sample_of(const CapturePlan& plan, int count) {
    return evenly(plan.frames.frames, size_t(may_feed_back(plan.scene) ? std::min(count, 1) : count));
}

/// Returns the largest difference of a sample, 0..1 for pictures of bytes; infinite if sizes differ.
double difference_of(const image::Image& a, const image::Image& b) {
    if (a.extent != b.extent || a.channels != b.channels)
        return std::numeric_limits<double>::infinity();
    const auto floats = [](const image::Image& image) {
        image::Image wide(image.extent, image.channels, image::SampleType::f32);
        wide.bytes = image::file_samples(image, image::SampleDepth::f32);
        return wide;
    };
    const image::Image x = floats(a);
    const image::Image y = floats(b);
    double largest = 0;
    for (size_t i = 0; i < x.samples(); ++i)
        if (const double d = std::abs(double(x.f32()[i]) - double(y.f32()[i])); !(d <= largest))
            largest = d;
    return largest;
}

/// Draws the plan's sample of frames into another folder; returns the plan for it.
Result<CapturePlan> draw_sample(const CapturePlan& whole, int count, const fs::path& folder,
                                Interrupt& interrupt) {
    CapturePlan plan = whole;
    plan.frames.frames = sample_of(whole, count);
    const std::string name =
        (whole.output.six_faces() ? "%d_{}" : "%d") + whole.output.pattern().extension().string();
    plan.output = TRY(OutputName::parse((folder / name).string(), plan.frames.frames.size()));
    auto compiled = TRY(compile(plan, interrupt));
    Capture run(plan, compiled);
    if (!TRY(run.run(interrupt)))
        return fail(ErrorCode::check_failed, "interrupted before the frames were compared");
    return plan;
}

/// Draws the sample again and returns the differences as messages; prints a message if there is none.
Result<std::vector<std::string>> compare_sample(const GatherOptions& options, const CapturePlan& whole,
                                                bool drawn_here, Interrupt& interrupt) {
    const ScratchFolder scratch;
    const CapturePlan again = TRY(draw_sample(whole, options.samples, scratch.path(), interrupt));
    const double allowed = drawn_here ? 0 : options.tolerance;
    std::vector<std::string> wrong;
    double largest = 0;
    for (const int frame : again.frames.frames)
        for (size_t i = 0; i < files_of(again.output, frame).size(); ++i) {
            const fs::path made = files_of(whole.output, frame)[i];
            const image::Image theirs = TRY(image::read_picture(made));
            const image::Image ours = TRY(image::read_picture(files_of(again.output, frame)[i]));
            const double difference = difference_of(theirs, ours);
            largest = std::max(largest, difference);
            if (!(difference <= allowed))
                wrong.push_back(fmt::format("{} looks different when drawn here: a sample differs by {:.3g}",
                                            made.string(), difference));
        }
    if (wrong.empty())
        say(fmt::format("{} of them drawn again for comparison: {}", again.frames.frames.size(),
                        drawn_here
                            ? "the same pixels"
                            : fmt::format("on this other device the largest difference is {:.3g}", largest)));
    return wrong;
}

/// Converts a picture to four channels of the same type, as encoders require.
image::Image for_video(const image::Image& picture) {
    if (picture.channels == 4)
        return picture;
    image::Image rgba(picture.extent, 4, picture.type);
    const size_t colours = picture.channels < 3 ? 1 : 3, sample = image::size_of(picture.type);
    const float one = 1;
    const uint8_t most = 255;
    const void* const opaque = picture.type == image::SampleType::u8 ? static_cast<const void*>(&most) : &one;
    for (size_t pixel = 0; pixel < rgba.extent.pixels(); ++pixel) {
        const std::byte* const from = &picture.bytes[pixel * size_t(picture.channels) * sample];
        std::byte* const to = &rgba.bytes[4 * pixel * sample];
        for (size_t channel = 0; channel < 3; ++channel)
            std::memcpy(to + channel * sample, from + channel % colours * sample, sample);
        std::memcpy(to + 3 * sample, picture.has_alpha() ? from + colours * sample : opaque, sample);
    }
    return rgba;
}

Result<void> make_video(const CapturePlan& pictures, const GatherOptions& options, Interrupt& interrupt) {
    const std::string& name = *options.video;
    CapturePlan plan = pictures;
    plan.output = TRY(OutputName::parse(name, plan.frames.frames.size()));
    if (!plan.output.video() || pictures.output.six_faces())
        return fail(ErrorCode::usage,
                    fmt::format("-o {}: give an .mp4, an .mkv, a .webm, a .mov, a .gif or a .webp", name));
    plan.video.codec = TRY(parse_codec(options.codec, plan.output));
    if (plan.encoding.alpha != image::Alpha::where_needed &&
        !image::video_holds_alpha(plan.output.pattern(), plan.video.codec, plan.encoding.alpha))
        return fail(
            ErrorCode::usage,
            fmt::format("-o {}: this format cannot store the alpha of the frames: give a .mov", name));
    if (plan.encoding.alpha == image::Alpha::premultiplied)
        plan.encoding.alpha = image::Alpha::straight; // in files, alpha is straight
    plan.video.segments = segments_of(plan.frames.frames, plan.video.pace, 0);
    const auto sound = draw_sound_of_video(plan, interrupt);
    std::optional<SegmentedVideo> video;
    for (const int frame : plan.frames.frames) {
        const image::Image picture = TRY(image::read_picture(pictures.output.of_frame(frame).path()));
        if (!video)
            video.emplace(TRY(SegmentedVideo::create(plan, picture.extent)));
        TRY(video->push(for_video(picture)));
    }
    TRY(video->finish(sound ? sound->path() : fs::path()));
    say(fmt::format("wrote {}: {}", name, counted_frames(plan.frames.frames.size())));
    return {};
}

/// Joins the segments that the shards made. They are not drawn again for comparison, which would require
/// decoding.
Result<void> join_video(const GatherOptions& options, const CapturePlan& plan, Interrupt& interrupt) {
    const std::string name = plan.output.pattern().string();
    if (options.video)
        return fail(
            ErrorCode::usage,
            fmt::format("-o {}: the shards made segments of '{}' and are joined to that video: remove -o",
                        *options.video, name));
    const auto sound = draw_sound_of_video(plan, interrupt);
    TRY(join(plan, sound ? sound->path() : fs::path()));
    say(fmt::format("wrote {}: {}", name, counted_frames(plan.frames.frames.size())));
    StagedFile::remove_abandoned(segment_file(plan.output, 0), StagedFile::Machines::all);
    return {};
}

int report(const std::vector<std::string>& wrong) {
    for (const std::string& line : wrong)
        say(line);
    return exit_code(ErrorCode::check_failed);
}

/// Returns exit code 1 if something is missing or different.
Result<int> gather(const GatherOptions& options) {
    Interrupt interrupt;
    const ShardNote note = TRY(read_note(options.folder / k_shard_note));
    CapturePlan plan = TRY(shared_plan(options, note));
    const auto context = TRY(host::HeadlessContext::create(plan.options.run.device));
    plan.identity.set_device(gl::query_capabilities());
    const Gathered found = gathered(plan, note.count);
    if (!found.wrong.empty())
        return report(found.wrong);
    say(fmt::format("{}: all complete, with one fingerprint, drawn by {}",
                    counted_frames(plan.frames.frames.size()), found.devices.begin()->first));
    if (plan.output.video())
        TRY(join_video(options, plan, interrupt));
    else if (options.samples > 0)
        if (const auto wrong = TRY(compare_sample(options, plan, found.drawn_here, interrupt));
            !wrong.empty())
            return report(wrong);
    if (options.video && !plan.output.video())
        TRY(make_video(plan, options, interrupt));
    remove_states(plan.output);
    for (const OutputPath& file : {plan.output.of_frame(0), state_file(plan.output, 0)})
        StagedFile::remove_abandoned(file, StagedFile::Machines::all); // no shard is running any more
    return 0;
}

} // namespace

void add_gather(Command app, Action& chosen) {
    auto options = std::make_shared<GatherOptions>();
    Command command =
        app.add_subcommand("gather", "Checks the frames of a capture's shards, and joins a video");
    command.add_option("FOLDER", options->folder, "Folder that the shards of `capture --shard` wrote into")
        .required()
        .check(existing_folder());
    command
        .add_option("-o,--output", options->video,
                    "Makes a video of the frames: .mp4 .mkv .webm .mov .gif .webp")
        .type_name("OUT");
    add_codec_option(command, options->codec);
    command.option("--codec").needs("--output");
    command.add_option("--sample", options->samples, "Number of frames to draw again and compare")
        .type_name("N")
        .check(non_negative_number())
        .capture_default_str();
    command
        .add_option("--tolerance", options->tolerance,
                    "Largest difference of a sample allowed if another device drew the frames [2/255]")
        .type_name("D")
        .check(non_negative_number());
    command.on_call([options, &chosen] { chosen = [options] { return gather(*options); }; });
}

} // namespace tidemark::cli
