// Pictures of a video at given times, through the program `ffmpeg` as a child process.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <memory>

namespace tidemark::image {

/// The longest video that is taken, in frames.
inline constexpr int k_most_video_frames = 1 << 20;

/// Frames are told apart by the times at which the file wants them shown, so a time gives the same picture
/// whatever was asked for before. One child decodes onward while times rise and is started anew, at the right
/// place, when they fall or jump. No child outlives this object. To be used from one thread at a time.
class VideoFrames {
public:
    /// Reads the times of all frames. ErrorCode::load: no such file, no video in it, too large, or no ffmpeg
    /// and ffprobe in PATH (the message says which package has them).
    static Result<VideoFrames> open(const std::filesystem::path& path);

    VideoFrames(VideoFrames&&) noexcept;
    VideoFrames& operator=(VideoFrames&&) noexcept;
    ~VideoFrames();

    Extent extent() const;
    int frame_count() const;
    /// From the first frame's appearance to the end of the last one's, in seconds; above 0.
    double duration() const;

    /// Which frame is shown at `seconds` after the start, counted from 0.
    size_t index_at(double seconds) const;
    /// The frame that is shown at `seconds` after the start: RGBA, u8, row 0 the bottom row. Times beyond the
    /// end and before 0 are taken modulo the duration.
    Result<Image> at(double seconds);

private:
    struct State;
    explicit VideoFrames(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tidemark::image
