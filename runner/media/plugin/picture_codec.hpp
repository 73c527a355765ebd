// Interface between the program and the picture plug-in: decodes a file's bytes to samples, and encodes
// samples to bytes or row by row into an open file. Both sides are built together; the version rejects a
// plug-in of another build. No exceptions cross it.
#pragma once

#include "media/image.hpp"
#include "media/picture_file.hpp"

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::image {

enum class FileFormat { png, jpeg, tiff, exr, hdr, bmp, webp, pnm, tga };

/// Samples in the type of the file (half: as f32, which the codec narrows), rows from the bottom.
struct EncodeJob {
    FileFormat format = FileFormat::png;
    SampleDepth depth = SampleDepth::u8;
    Extent extent;
    int channels = 3;
    std::vector<std::byte> samples;
    std::vector<std::pair<std::string, std::string>> attributes; ///< texts, under their final names
    std::optional<Transfer> transfer{};                          ///< of `samples`
    std::vector<std::byte> icc_profile{};                        ///< matches `transfer`; empty: none
    bool premultiplied = false;                                  ///< colours are multiplied by alpha
    std::string part{};                                          ///< name of the part in a file of several
};

/// The error is the reason alone, in one line.
using EncodeResult = tl::expected<std::vector<unsigned char>, std::string>;
using DecodeResult = tl::expected<Image, std::string>;
using TextsResult = tl::expected<std::vector<std::pair<std::string, std::string>>, std::string>;

/// Writes a picture into a file, from the top down.
class RowEncoder {
public:
    using Done = tl::expected<void, std::string>;

    virtual ~RowEncoder() = default;
    /// Adds the next rows below the earlier ones; within `samples` they run from the bottom.
    virtual Done add(std::span<const std::byte> samples, int rows) noexcept = 0;
    /// Completes the picture after the last row. Does not close the file.
    virtual Done finish() noexcept = 0;
};
using RowEncoderResult = tl::expected<std::unique_ptr<RowEncoder>, std::string>;

struct PictureCodec {
    unsigned version;
    EncodeResult (*encode)(const EncodeJob&) noexcept;
    DecodeResult (*decode)(FileFormat, std::span<const std::byte>) noexcept;
    /// Reads the texts of a picture's header, without its pixels.
    TextsResult (*texts)(FileFormat, std::span<const std::byte>) noexcept;
    /// Starts to encode a job without samples into an empty file, which must outlive the encoder.
    RowEncoderResult (*encode_rows)(const EncodeJob&, std::FILE*) noexcept;
    /// Encodes several named pictures in one file. They may differ in size, channels and depth.
    EncodeResult (*encode_parts)(std::span<const EncodeJob>) noexcept;
};

inline constexpr unsigned k_picture_codec_version = 5;
inline constexpr const char* k_picture_codec_entry = "tidemark_picture_codec";

} // namespace tidemark::image
