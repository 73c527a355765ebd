#include "cli/capture/segmented_video.hpp"

#include "base/try.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <system_error>
#include <thread>

namespace tidemark::cli {
namespace {

/// The usual distance of key frames in libx264, so that a long video does not grow by its segments.
constexpr int k_default_length = 250;

size_t ticks_in(const VideoSegment& segment) {
    return std::accumulate(segment.ticks.begin(), segment.ticks.end(), size_t{0});
}

} // namespace

std::vector<VideoSegment> segments_of(const std::vector<int>& frames, const VideoPace& pace, int length) {
    const auto step = std::ptrdiff_t(length > 0 ? length : k_default_length);
    std::vector<VideoSegment> segments;
    const std::vector<int> ticks = ticks_of(frames, pace);
    for (auto first = frames.begin(); first != frames.end();) {
        const auto end = first + std::min(step, frames.end() - first);
        const auto ticks_from = ticks.begin() + (first - frames.begin());
        segments.push_back({{first, end}, {ticks_from, ticks_from + (end - first)}});
        first = end;
    }
    return segments;
}

OutputPath segment_file(const OutputName& video, size_t index) {
    return video.of_frame(0).beside(
        fmt::format(".segment-{:04}{}", index, image::segment_extension(video.pattern())));
}

std::string note_of(const CapturePlan& plan, const VideoSegment& segment, const Fingerprint& run) {
    const render::FrameStates states = states_of(plan.frames);
    std::vector<render::FrameState> seen;
    for (const int frame : segment.frames)
        seen.push_back(states(frame));
    return run.of_frames(seen).text();
}

Result<SegmentedVideo> SegmentedVideo::create(const CapturePlan& plan, Fingerprint run, Extent extent) {
    SegmentedVideo video(plan, std::move(run), extent);
    TRY(video.claim());
    TRY(video.open_next());
    return video;
}

/// Claims the video for this process. If two begin at the same moment, the one with the lower process ID goes
/// on. Waits up to a second, since a killed process may take a moment to end.
Result<void> SegmentedVideo::claim() {
    constexpr std::chrono::milliseconds k_patience(1000), k_pause(20);
    const OutputPath mark = plan_.output.of_frame(0).beside(
        plan_.shard ? fmt::format(".shard-{}", plan_.shard->index) : ".capture");
    const auto refuse = [&](pid_t other) {
        return fail(
            ErrorCode::write,
            fmt::format("cannot write '{}': process {} is making it: wait for its end, or give another "
                        "name (-o)",
                        plan_.output.pattern().string(), other));
    };
    pid_t other = StagedFile::other_maker_of(mark);
    for (auto waited = k_pause; other != 0 && waited < k_patience; waited += k_pause) {
        std::this_thread::sleep_for(k_pause);
        other = StagedFile::other_maker_of(mark);
    }
    if (other != 0)
        return refuse(other);
    claim_.emplace(TRY(StagedFile::create(mark)));
    other = StagedFile::other_maker_of(mark);
    return other != 0 && other < ::getpid() ? refuse(other) : Result<void>();
}

Result<void> SegmentedVideo::open_next() {
    const std::vector<VideoSegment>& segments = plan_.segments;
    while (next_ < segments.size() && !segments[next_].is_to_be_made())
        ++next_;
    if (next_ == segments.size())
        return {};
    writer_.emplace(TRY(
        image::SegmentWriter::create(segment_file(plan_.output, next_), plan_.output.pattern(), format())));
    pushed_ = 0;
    ++next_;
    return {};
}

Result<void> SegmentedVideo::push(const image::Image& image) {
    if (!writer_)
        TRY(open_next());
    for (int tick = 0; tick < plan_.segments[next_ - 1].ticks[pushed_]; ++tick)
        TRY(writer_->push(image));
    return ++pushed_ < plan_.segments[next_ - 1].frames.size() ? Result<void>() : close();
}

Result<void> SegmentedVideo::close() {
    auto written = writer_->finish(note_of(plan_, plan_.segments[next_ - 1], run_));
    writer_.reset();
    if (written)
        written_ += pushed_;
    return written;
}

Result<void> SegmentedVideo::finish(const std::filesystem::path& sound) {
    std::vector<image::SegmentFile> files;
    for (size_t i = 0; i < plan_.segments.size(); ++i)
        files.push_back({segment_file(plan_.output, i).path(), ticks_in(plan_.segments[i])});
    TRY(image::join_segments(plan_.output.of_frame(0), files, format(), sound));
    remove_segments();
    return {};
}

Result<void> join(CapturePlan plan, const Fingerprint& run, const std::filesystem::path& sound) {
    for (VideoSegment& segment : plan.segments)
        segment.kept = true;
    SegmentedVideo video = TRY(SegmentedVideo::create(plan, run, plan.drawing.extent));
    return video.finish(sound);
}

/// Also removes the segments of a longer, abandoned capture.
void SegmentedVideo::remove_segments() const {
    std::error_code ignored;
    for (size_t i = 0; std::filesystem::remove(segment_file(plan_.output, i).path(), ignored); ++i) {
    }
    StagedFile::remove_abandoned(segment_file(plan_.output, 0));
}

} // namespace tidemark::cli
