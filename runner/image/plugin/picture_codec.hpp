// What the program and the picture plug-in say to each other: bytes of a file in, samples out, and the
// other way round. Both are built together; the version refuses a plug-in of another build. No file is
// opened and nothing is thrown across.
#pragma once

#include "image/image.hpp"
#include "image/picture_file.hpp"

#include <tl/expected.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::image {

enum class FileFormat { png, jpeg, tiff, exr, hdr, bmp, webp, pnm, tga };

/// Samples in the type that the file will hold (half: as f32, the codec narrows), rows from the bottom.
struct EncodeJob {
    FileFormat format = FileFormat::png;
    SampleDepth depth = SampleDepth::u8;
    Extent extent;
    int channels = 3;
    std::vector<std::byte> samples;
    std::vector<std::pair<std::string, std::string>> attributes; ///< text, under its final name
};

/// The error is the reason alone, in one line.
using EncodeResult = tl::expected<std::vector<unsigned char>, std::string>;
using DecodeResult = tl::expected<Image, std::string>;

struct PictureCodec {
    unsigned version;
    EncodeResult (*encode)(const EncodeJob&) noexcept;
    DecodeResult (*decode)(FileFormat, std::span<const std::byte>) noexcept;
};

inline constexpr unsigned k_picture_codec_version = 1;
inline constexpr const char* k_picture_codec_entry = "tidemark_picture_codec";
using PictureCodecEntry = const PictureCodec* (*)();

} // namespace tidemark::image
