// What ffmpeg is told for each kind of video: how a segment of it is encoded, and how segments become a
// whole.
#pragma once

#include "base/extent.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::image {

/// H.264 (with AAC) in .mp4, VP9 (with Opus) in .webm, ProRes 4444 (with PCM) in .mov; colours as BT.709. A
/// GIF has a palette for each frame, a WebP all bytes of it. These two and ProRes are encoded when they are
/// whole; until then their frames are kept without loss.
struct VideoEncoding {
    std::string_view extension;
    /// From frames that run from the bottom up into an .mp4 without sound.
    std::vector<std::string> (*segment)(Extent extent);
    /// From such segments, and a sound, into the whole.
    std::vector<std::string> whole;
};

/// By the name's extension; null where it is none of a video.
const VideoEncoding* encoding_of(const std::filesystem::path& path);

/// What both begin with.
std::vector<std::string> ffmpeg_words();
/// The same frames make the same file: no date, no version.
std::vector<std::string> reproducible_words();

} // namespace tidemark::image
