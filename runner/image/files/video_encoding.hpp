// ffmpeg's options for each kind of video: for encoding a segment, and for joining segments.
#pragma once

#include "base/result.hpp"
#include "image/files/video_writer.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// An encoding of a file type: H.264, HEVC and AV1 (with AAC) in .mp4 and .mkv, VP9 and AV1 (with Opus) in
/// .webm, ProRes 4444 (with PCM) in .mov; colours as BT.709. A GIF has a palette per frame, a WebP keeps all
/// bytes. These two, and VP9 with alpha, are encoded when segments are joined; until then the frames are
/// stored without loss.
struct VideoEncoding {
    std::string_view extension;
    std::string_view codec;    ///< as --codec names it; empty: unnamed
    bool ten_bits;             ///< per sample; else 8
    std::vector<Alpha> alphas; ///< supported kinds
    /// Returns the options for a segment, a file without sound, with that encoder (`encoder_of`).
    std::vector<std::string> (*segment)(const VideoFormat& format, std::string_view encoder);
    /// Options for joining segments and sound.
    std::vector<std::string> whole;
};

const std::vector<VideoEncoding>& encodings();

/// Returns the file extension of segments: ProRes needs .mov, because MP4 has no ProRes.
std::string_view segment_extension(const VideoEncoding& encoding);
/// Returns ffmpeg's format name for files of that extension.
std::string_view muxer_of(std::string_view extension);

/// Finds an encoding by the file's extension, the codec (empty: the extension's default) and the required
/// alpha; null if there is none.
const VideoEncoding* encoding_of(const std::filesystem::path& path, std::string_view codec = {},
                                 Alpha alpha = Alpha::where_needed);

/// Returns ffmpeg's name of the first encoder of that codec that this ffmpeg has and that supports the size.
/// Empty for a codec without a choice of encoders. Fails (ErrorCode::write) if none fits.
Result<std::string_view> encoder_of(std::string_view codec, Extent extent);

/// Returns the colour tags for planes of 10 bits, which are BT.709 already.
std::vector<std::string> colour_words();
/// Returns the start of the command line for encoding and joining.
std::vector<std::string> ffmpeg_words();
/// Returns options that keep date and version out of the file, so that equal frames give equal files.
std::vector<std::string> reproducible_words();

} // namespace tidemark::image
