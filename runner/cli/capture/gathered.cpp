#include "cli/capture/gathered.hpp"

#include "cli/capture/kept_frames.hpp"
#include "cli/capture/segmented_video.hpp"
#include "cli/picture_facts.hpp"
#include "cli/progress.hpp"
#include "image/files/picture_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

/// Frames with the same problem, with the file of the first one.
struct Wrong {
    std::string what;
    std::string first;
    size_t count = 0;
};

/// Returns the problem of one file; empty if there is none.
std::string look_at(const std::filesystem::path& file, const Fingerprint& wanted, Gathered& gathered) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        return "missing";
    const auto metadata = image::read_metadata(file);
    if (!metadata)
        return "not whole: " + metadata.error();
    const std::string* text = image::find(*metadata, k_fingerprint);
    if (!text)
        return "without a fingerprint";
    const Fingerprint found = Fingerprint::parse(*text);
    const std::string* device = image::find(*metadata, "Driver");
    ++gathered.devices[device ? *device : "an unknown device"];
    gathered.drawn_here &= wanted.on_device_of(found) == wanted;
    const std::string others = wanted.on_device_of(found).differences(found);
    return others.empty() ? "" : "drawn with " + others;
}

void note(std::vector<Wrong>& all, std::string what, const std::string& file) {
    const auto known = std::ranges::find(all, what, &Wrong::what);
    if (known != all.end())
        ++known->count;
    else
        all.push_back({std::move(what), file, 1});
}

/// Returns the problem of one segment of a video; empty if there is none.
std::string look_at_segment(const std::filesystem::path& file, const Fingerprint& wanted,
                            Gathered& gathered) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        return "missing";
    const auto note = image::note_of_segment(file);
    if (!note)
        return "not whole";
    const Fingerprint found = Fingerprint::parse(*note);
    const bool here = wanted.on_device_of(found) == wanted;
    ++gathered.devices[here ? "this device" : fmt::format("device {}", found.device())];
    gathered.drawn_here &= here;
    const std::string others = wanted.on_device_of(found).differences(found);
    return others.empty() ? "" : "drawn with " + others;
}

int shard_of_segment(const CapturePlan& plan, int shards, const std::string& file) {
    for (int index = 0; index < shards; ++index)
        for (const int segment : segments_of_shard({index, shards}, plan.segments.size(), plan.scene))
            if (segment_file(plan.output, size_t(segment)).path().string() == file)
                return index + 1;
    return 0;
}

/// Returns the number of the shard that makes the frame of this file.
int shard_of(const CapturePlan& plan, int shards, const std::string& file) {
    for (int index = 0; index < shards; ++index)
        for (const int frame : frames_of({index, shards}, plan.frames.frames, plan.scene))
            for (const auto& made : files_of(plan.output, frame))
                if (made.string() == file)
                    return index + 1;
    return 0;
}

void count_devices(Gathered& result, std::string_view what) {
    if (result.devices.size() > 1)
        for (const auto& [device, count] : result.devices)
            result.wrong.push_back(fmt::format("{} {} were drawn by {}", count, what, device));
}

Gathered gathered_segments(const CapturePlan& plan, const Fingerprint& run, int shards) {
    Gathered result;
    std::vector<Wrong> all;
    Progress progress("segments looked at", plan.segments.size());
    for (size_t i = 0; i < plan.segments.size(); ++i, progress.advance()) {
        const auto file = segment_file(plan.output, i).path();
        const Fingerprint wanted = Fingerprint::parse(note_of(plan, plan.segments[i], run));
        if (auto what = look_at_segment(file, wanted, result); !what.empty())
            note(all, std::move(what), file.string());
    }
    for (const auto& [what, first, count] : all)
        result.wrong.push_back(fmt::format("{} of {} segments: {}, {} first (shard {}/{})", count,
                                           plan.segments.size(), what, first,
                                           shard_of_segment(plan, shards, first), shards));
    std::error_code ignored;
    if (result.devices.empty() && std::filesystem::exists(plan.output.pattern(), ignored))
        result.wrong.push_back(
            fmt::format("{} is there, and none of its segments: where it was joined before, "
                        "nothing is left to do",
                        plan.output.pattern().string()));
    count_devices(result, "segments");
    return result;
}

} // namespace

Gathered gathered(const CapturePlan& plan, const Fingerprint& run, int shards) {
    if (plan.output.video())
        return gathered_segments(plan, run, shards);
    Gathered result;
    std::vector<Wrong> all;
    const render::FrameStates states = states_of(plan.frames);
    Progress progress("frames looked at", plan.frames.frames.size());
    for (const int frame : plan.frames.frames) {
        for (const std::filesystem::path& file : files_of(plan.output, frame))
            if (auto what = look_at(file, run.of_frame(states(frame)), result); !what.empty())
                note(all, std::move(what), file.string());
        progress.advance();
    }
    for (const auto& [what, first, count] : all)
        result.wrong.push_back(fmt::format("{} of {} frames: {}, {} first (shard {}/{})", count,
                                           plan.frames.frames.size(), what, first,
                                           shard_of(plan, shards, first), shards));
    count_devices(result, "frames");
    return result;
}

} // namespace tidemark::cli
