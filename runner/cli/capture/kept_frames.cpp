#include "cli/capture/kept_frames.hpp"

#include "cli/capture/segmented_video.hpp"
#include "cli/picture_facts.hpp"
#include "image/files/picture_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

/// Returns the first file that cannot be kept, and why; an empty reason means that it is missing. Returns
/// nothing if the frame is kept.
std::optional<std::pair<fs::path, std::string>> objection_to(const std::vector<fs::path>& files,
                                                             const Fingerprint& wanted) {
    std::error_code ignored;
    for (const fs::path& file : files) {
        if (!fs::is_regular_file(fs::symlink_status(file, ignored)))
            return std::pair(file, std::string());
        if (std::string why = why_not_kept(file, wanted); !why.empty())
            return std::pair(file, std::move(why));
    }
    return std::nullopt;
}

/// Frames that are drawn again for the same reason.
struct Again {
    std::string why;
    fs::path first;
    size_t count = 0;
};

void note(std::vector<Again>& all, fs::path file, std::string why) {
    const auto known = std::ranges::find(all, why, &Again::why);
    if (known != all.end())
        ++known->count;
    else
        all.push_back({std::move(why), std::move(file), 1});
}

KeptFrames leave_out_pictures(CapturePlan& plan, const Fingerprint& run) {
    const render::FrameStates states = states_of(plan.frames);
    KeptFrames kept;
    std::vector<int> missing;
    std::vector<Again> again;
    for (const int frame : plan.frames.frames) {
        auto objection = objection_to(files_of(plan.output, frame), run.of_frame(states(frame)));
        (objection ? missing : kept.frames).push_back(frame);
        if (!objection)
            continue;
        if (!objection->second.empty())
            note(again, std::move(objection->first), std::move(objection->second));
    }
    for (const auto& [why, first, count] : again)
        kept.said.push_back(
            count == 1 ? fmt::format("drawing {} again: {}", first.string(), why)
                       : fmt::format("drawing {} frames again, {} first: {}", count, first.string(), why));
    plan.frames.frames = std::move(missing);
    return kept;
}

KeptFrames leave_out_segments(CapturePlan& plan, const Fingerprint& run) {
    KeptFrames kept;
    std::vector<int> missing;
    for (size_t i = 0; i < plan.segments.size(); ++i) {
        VideoSegment& segment = plan.segments[i];
        if (segment.others)
            continue;
        const auto note = image::note_of_segment(segment_file(plan.output, i).path());
        segment.kept = note && *note == note_of(plan, segment, run);
        std::vector<int>& into = segment.kept ? kept.frames : missing;
        into.insert(into.end(), segment.frames.begin(), segment.frames.end());
        if (note && !segment.kept)
            kept.said.push_back(fmt::format(
                "drawing frames {} to {} again: they were drawn with {}", segment.frames.front(),
                segment.frames.back(),
                Fingerprint::parse(note_of(plan, segment, run)).differences(Fingerprint::parse(*note))));
    }
    plan.frames.frames = std::move(missing);
    return kept;
}

} // namespace

std::vector<fs::path> files_of(const OutputName& output, int frame) {
    if (!output.six_faces())
        return {output.of_frame(frame).path()};
    std::vector<fs::path> files;
    for (size_t face = 0; face < 6; ++face)
        files.push_back(output.of_face(frame, face).path());
    return files;
}

std::string why_not_kept(const fs::path& file, const Fingerprint& wanted) {
    const auto metadata = image::read_metadata(file);
    if (!metadata)
        return metadata.error();
    const std::string* text = image::find(*metadata, k_fingerprint);
    if (!text)
        return "it does not say how it was drawn";
    const std::string differences = wanted.differences(Fingerprint::parse(*text));
    return differences.empty() ? "" : "it was drawn with " + differences;
}

KeptFrames leave_out_kept(CapturePlan& plan, const Fingerprint& run) {
    return plan.output.video() ? leave_out_segments(plan, run) : leave_out_pictures(plan, run);
}

} // namespace tidemark::cli
