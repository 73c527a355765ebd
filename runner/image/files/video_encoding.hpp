// What ffmpeg is told for each kind of video: how a segment of it is encoded, and how segments become a
// whole.
#pragma once

#include "base/result.hpp"
#include "image/files/video_writer.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// H.264, HEVC and AV1 (with AAC) in .mp4 and .mkv, VP9 and AV1 (with Opus) in .webm, ProRes 4444 (with PCM)
/// in .mov; colours as BT.709. A GIF has a palette for each frame, a WebP all bytes of it: these two, and
/// VP9 with alpha, are encoded when they are whole; until then their frames are kept without loss.
struct VideoEncoding {
    std::string_view extension;
    std::string_view codec;    ///< as --codec names it; empty: it has no name there
    bool ten_bits;             ///< a sample; else 8
    std::vector<Alpha> alphas; ///< that it can hold
    /// Into a file without sound, by that encoder (`encoder_of`).
    std::vector<std::string> (*segment)(const VideoFormat& format, std::string_view encoder);
    /// From such segments, and a sound, into the whole.
    std::vector<std::string> whole;
};

const std::vector<VideoEncoding>& encodings();

/// Of the file that a segment is: MP4 has no ProRes.
std::string_view segment_extension(const VideoEncoding& encoding);
/// ffmpeg's name of the format that files of that extension have.
std::string_view muxer_of(std::string_view extension);

/// By the name's extension, the codec (empty: the one that such a file has by nature) and the alpha that it
/// is to hold; null where there is none.
const VideoEncoding* encoding_of(const std::filesystem::path& path, std::string_view codec = {},
                                 Alpha alpha = Alpha::where_needed);

/// The first of the encoders of that codec which this ffmpeg has and which takes that size, as ffmpeg names
/// it. Fails (ErrorCode::write) where there is none.
Result<std::string_view> encoder_of(std::string_view codec, Extent extent);

/// What is said of colours that are coded by BT.709 already: of planes of 10 bits.
std::vector<std::string> colour_words();
/// What both begin with.
std::vector<std::string> ffmpeg_words();
/// The same frames make the same file: no date, no version.
std::vector<std::string> reproducible_words();

} // namespace tidemark::image
