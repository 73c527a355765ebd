// A video on its way to disk, in segments that lie beside it until they are joined: what ends a capture costs
// it one segment at most.
#pragma once

#include "base/file.hpp"
#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"
#include "image/files/video_writer.hpp"

#include <filesystem>
#include <optional>

namespace tidemark::cli {

/// `length`: frames in each but the last; 0: as nobody said it.
std::vector<VideoSegment> segments_of(const std::vector<int>& frames, const VideoPace& pace, int length);

/// `wave.mp4.segment-0003.mp4`.
OutputPath segment_file(const OutputName& video, size_t index);

/// What a segment's note says.
std::string note_of(const CapturePlan& plan, const VideoSegment& segment, const Fingerprint& run);

class SegmentedVideo {
public:
    /// `plan` must outlive it. The first encoder is started, where there is anything to encode. Fails
    /// (ErrorCode::write) while another process makes the same video, or the same shard of it.
    static Result<SegmentedVideo> create(const CapturePlan& plan, Fingerprint run, Extent extent);

    /// The next frame of those that are not kept.
    Result<void> push(const image::Image& image);
    /// The segment in hand is given up.
    void drop() { writer_.reset(); }
    /// Frames in segments that are on disk, but for those that were kept.
    size_t written() const { return written_; }
    /// Joins the segments, with a WAV file where `sound` names one, and removes them.
    Result<void> finish(const std::filesystem::path& sound);

private:
    SegmentedVideo(const CapturePlan& plan, Fingerprint run, Extent extent)
        : plan_(plan), run_(std::move(run)), extent_(extent) {}
    Result<void> claim();
    Result<void> open_next();
    Result<void> close();
    image::VideoFormat format() const { return {extent_, plan_.pace.fps, plan_.codec, plan_.alpha}; }
    void remove_segments() const;

    const CapturePlan& plan_;
    Fingerprint run_;
    Extent extent_;
    size_t next_ = 0; ///< segment that is not in hand yet
    size_t written_ = 0;
    size_t pushed_ = 0; ///< frames of the one in hand
    std::optional<image::SegmentWriter> writer_;
    std::optional<StagedFile> claim_; ///< tells other processes of this one; never committed
};

/// Of segments that are all there.
Result<void> join(CapturePlan plan, const Fingerprint& run, const std::filesystem::path& sound);

} // namespace tidemark::cli
