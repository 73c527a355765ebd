// Parses the display times of a video's frames from the output of ffprobe and ffmpeg.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
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

} // namespace tidemark::image
