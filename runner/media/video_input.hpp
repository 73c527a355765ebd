// Videos and cameras as inputs, read through ffmpeg.
//
// Parses the display times of a video's frames from the output of ffprobe and ffmpeg.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "media/image.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// Display times of all frames, in ticks of the file's clock, which are `tick` seconds long.
struct VideoTimes {
    Extent extent{};
    double tick = 0.0;
    std::vector<int64_t> starts{}; ///< ticks at which frames appear, ascending; not empty
    int64_t end = 0;               ///< tick at which the last frame ends
    bool guessed = false;          ///< the file does not store when each frame appears (AVI with B frames)

    double duration() const { return double(end - starts.front()) * tick; }

    /// Returns the index of the frame that is shown at a time. Times after the end and before 0 are taken
    /// modulo the duration. A frame appears up to half a millisecond early, and never more than half a tick,
    /// because file clocks in milliseconds and the caller's times are rounded.
    size_t frame_at(double seconds) const;
};

/// Parses the output of ffprobe for `video_times_arguments`. The error is the reason, without the file's
/// name.
tl::expected<VideoTimes, std::string> parse_video_times(std::string_view text);

/// Returns the tick at which a frame appears, from a line that ffmpeg's filter `showinfo` prints; nothing for
/// any other line.
std::optional<int64_t> showinfo_start(std::string_view line);

/// Replaces guessed times by those that the decoder found.
void set_starts(VideoTimes& times, std::vector<int64_t> starts);

/// Returns input arguments that restrict ffmpeg and ffprobe to one file of a format that contains its video.
/// A playlist or a script could name any other file or an address.
std::vector<std::string> video_input_arguments(const std::filesystem::path& path);

std::vector<std::string> video_times_arguments(const std::filesystem::path& path);

/// Follows "there is no program 'ffmpeg' in PATH" in error messages.
inline constexpr std::string_view k_get_ffmpeg = ", which videos need; install the package ffmpeg";

// Delivers the picture of a video at a given time, through a child process `ffmpeg`.

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
    /// Returns the time of the first frame by the file's clock, in seconds.
    double start() const;
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

// Delivers the current picture of a camera, through a child process `ffmpeg`.

/// The size of camera pictures: they are scaled to it, and cropped on the longer side.
inline constexpr Extent k_camera_extent{640, 480};

/// A thread receives the pictures; the object is for use on another thread. The child process ends with the
/// object.
class Camera {
public:
    /// Opens a Video4Linux device such as `/dev/video0`, or a video, which is looped at its own speed. Waits
    /// for the first picture. Fails with the reason (ErrorCode::load) when there is none.
    static Result<Camera> open(const std::filesystem::path& path);
    Camera(Camera&&) noexcept;
    Camera& operator=(Camera&&) noexcept;
    ~Camera();

    /// Returns the newest picture: RGBA, u8, row 0 the bottom row. It stays when no more pictures come.
    std::shared_ptr<const Image> newest() const;

private:
    class Feed;
    explicit Camera(std::unique_ptr<Feed> feed);

    std::unique_ptr<Feed> feed_;
};

// Checks that a video's file is as long as it declares, because ffmpeg plays the rest of a truncated file
// without an error. Handles MP4 and MOV, WebM and Matroska, Ogg, GIF and AVI; other formats do not declare a
// length. Reads some bytes, decodes nothing.

/// Returns whether the video is complete; also true for unreadable files and other formats.
bool is_whole_video(const std::filesystem::path& path);

/// Returns whether the file is complete and of the format that ffmpeg calls `mp4`, `mov`, `matroska`, `webm`,
/// `gif` or `webp`. MP4 and MOV must contain an index (`moov`).
bool is_video_of(const std::filesystem::path& path, std::string_view muxer);

} // namespace tidemark::image
