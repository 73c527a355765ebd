// Delivers the picture of a video at a given time, through a child process `ffmpeg`.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <memory>

namespace tidemark::image {

/// The limit of a video's length, in frames.
inline constexpr int k_most_video_frames = 1 << 20;

/// A video opened for reading. Frames are identified by their display times in the file, so a time gives the
/// same picture regardless of earlier requests. One child decodes forwards while times rise, and is restarted
/// at the right place when they fall or jump. The child ends with the object. For use on one thread at a
/// time.
class VideoFrames {
public:
    /// Reads the times of all frames. Fails (ErrorCode::load) if the file does not exist, has no video or is
    /// too large, or if ffmpeg and ffprobe are not in PATH (the message names the package).
    static Result<VideoFrames> open(const std::filesystem::path& path);

    VideoFrames(VideoFrames&&) noexcept;
    VideoFrames& operator=(VideoFrames&&) noexcept;
    ~VideoFrames();

    Extent extent() const;
    int frame_count() const;
    /// Returns the time from the start of the first frame to the end of the last one, in seconds; above 0.
    double duration() const;

    /// Returns the index of the frame that is shown at `seconds` after the start.
    size_t index_at(double seconds) const;
    /// Returns the frame that is shown at `seconds` after the start: RGBA, u8, row 0 the bottom row. Times
    /// after the end and before 0 are taken modulo the duration.
    Result<Image> at(double seconds);

private:
    struct State;
    explicit VideoFrames(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tidemark::image
