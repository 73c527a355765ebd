// When the frames of a video are shown, as the file says.
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

/// Ticks are of the file's own clock, `tick` seconds long.
struct VideoTimes {
    Extent extent{};
    double tick = 0.0;
    std::vector<int64_t> starts{}; ///< ticks at which frames appear, rising; not empty
    int64_t end = 0;               ///< tick at which the last frame goes
    bool guessed = false;          ///< the file does not say when each frame appears (AVI with B frames)

    double duration() const { return double(end - starts.front()) * tick; }

    /// The frame that is shown at a time: index into `starts`. Times beyond the end and before 0 are taken
    /// modulo the duration. A frame appears up to half a millisecond, and never more than half a tick, early:
    /// clocks of files that count milliseconds are rounded, and so are the times of a caller.
    size_t frame_at(double seconds) const;
};

/// What ffprobe prints with `-of compact` for `video_times_arguments`. The error is what is wrong, without
/// the name of the file.
tl::expected<VideoTimes, std::string> parse_video_times(std::string_view text);

/// The tick at which a frame appears, from a line that ffmpeg's filter `showinfo` prints; nothing when the
/// line is another.
std::optional<int64_t> showinfo_start(std::string_view line);

/// Puts what the decoder found in the place of what was guessed.
void set_starts(VideoTimes& times, std::vector<int64_t> starts);

/// Restricts ffmpeg and ffprobe to one file of a kind that holds its video itself: a play list or a script
/// could name any other file, or an address.
std::vector<std::string> video_input_arguments(const std::filesystem::path& path);

std::vector<std::string> video_times_arguments(const std::filesystem::path& path);

/// Behind "there is no program 'ffmpeg' in PATH".
inline constexpr std::string_view k_get_ffmpeg = ", which videos need; install the package ffmpeg";

} // namespace tidemark::image
