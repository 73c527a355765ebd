// Writes a video in segments, which lie next to it until they are joined: an interrupted capture loses at
// most one segment.
#pragma once

#include "base/file.hpp"
#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"
#include "image/files/video_writer.hpp"

#include <filesystem>
#include <optional>

namespace tidemark::cli {

/// `length`: frames in each segment except the last; 0: the default.
std::vector<VideoSegment> segments_of(const std::vector<int>& frames, const VideoPace& pace, int length);

/// Returns for example `wave.mp4.segment-0003.mp4`.
OutputPath segment_file(const OutputName& video, size_t index);

/// Returns the fingerprint that a segment stores as its note.
std::string note_of(const CapturePlan& plan, const VideoSegment& segment, const Fingerprint& run);

class SegmentedVideo {
public:
    /// `plan` must outlive it. Starts the first encoder if there is anything to encode. Fails
    /// (ErrorCode::write) while another process makes the same video, or the same shard of it.
    static Result<SegmentedVideo> create(const CapturePlan& plan, Fingerprint run, Extent extent);

    /// Encodes the next frame of those that are not kept.
    Result<void> push(const image::Image& image);
    /// Drops the current segment.
    void drop() { writer_.reset(); }
    /// Returns the number of frames in segments that this run wrote to disk.
    size_t written() const { return written_; }
    /// Joins the segments, with the WAV file `sound` if it is not empty, and removes them.
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
    size_t next_ = 0; ///< the next segment to begin
    size_t written_ = 0;
    size_t pushed_ = 0; ///< frames of the current segment
    std::optional<image::SegmentWriter> writer_;
    std::optional<StagedFile> claim_; ///< marks the video as being made by this process; never committed
};

/// Joins segments that all exist.
Result<void> join(CapturePlan plan, const Fingerprint& run, const std::filesystem::path& sound);

} // namespace tidemark::cli
