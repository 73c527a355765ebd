// What the program and the picture plug-in say to each other: bytes of a file in, samples out, and the
// other way round; or rows into a file that the program has opened. Both are built together; the version
// refuses a plug-in of another build. Nothing is thrown across.
#pragma once

#include "image/files/picture_file.hpp"
#include "image/image.hpp"

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

/// Samples in the type that the file will hold (half: as f32, the codec narrows), rows from the bottom.
struct EncodeJob {
    FileFormat format = FileFormat::png;
    SampleDepth depth = SampleDepth::u8;
    Extent extent;
    int channels = 3;
    std::vector<std::byte> samples;
    std::vector<std::pair<std::string, std::string>> attributes; ///< text, under its final name
    std::optional<Transfer> transfer{};                          ///< of these samples
    std::vector<std::byte> icc_profile{};                        ///< that says the same; empty: none
    bool premultiplied = false;                                  ///< colours, by alpha
    std::string part{};                                          ///< its name among several in a file
};

/// The error is the reason alone, in one line.
using EncodeResult = tl::expected<std::vector<unsigned char>, std::string>;
using DecodeResult = tl::expected<Image, std::string>;
using TextsResult = tl::expected<std::vector<std::pair<std::string, std::string>>, std::string>;

/// A picture on its way into a file, from the top down.
class RowEncoder {
public:
    using Done = tl::expected<void, std::string>;

    virtual ~RowEncoder() = default;
    /// The next rows below those that were given before; within `samples` they run from the bottom.
    virtual Done add(std::span<const std::byte> samples, int rows) noexcept = 0;
    /// After the last row. The file is not closed.
    virtual Done finish() noexcept = 0;
};
using RowEncoderResult = tl::expected<std::unique_ptr<RowEncoder>, std::string>;

struct PictureCodec {
    unsigned version;
    EncodeResult (*encode)(const EncodeJob&) noexcept;
    DecodeResult (*decode)(FileFormat, std::span<const std::byte>) noexcept;
    /// The texts of a picture's header, which no pixel is read for.
    TextsResult (*texts)(FileFormat, std::span<const std::byte>) noexcept;
    /// Of a job without samples, into an empty file. The file must outlive it.
    RowEncoderResult (*encode_rows)(const EncodeJob&, std::FILE*) noexcept;
    /// Several pictures in one file, each under its name. They may differ in size, channels and depth.
    EncodeResult (*encode_parts)(std::span<const EncodeJob>) noexcept;
};

inline constexpr unsigned k_picture_codec_version = 5;
inline constexpr const char* k_picture_codec_entry = "tidemark_picture_codec";

} // namespace tidemark::image
