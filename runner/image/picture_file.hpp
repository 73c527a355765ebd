// Pictures in files. The codec (OpenImageIO) sits in a plug-in that is loaded when a picture is first
// read or written, or ahead of that on a thread of its own by `preload_picture_codec`.
// Files run from the top row down, an Image from the bottom row up: this is the one place that flips.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::image {

/// What one sample is in the file.
enum class SampleDepth { u8, u16, half, f32 };

/// How a picture is stored. Metadata travels as text attributes where the format has them.
struct PictureFormat {
    SampleDepth depth = SampleDepth::u8;
    std::vector<std::pair<std::string, std::string>> metadata{};
};

/// Whether `path` ends in a format we write (.png .jpg .jpeg .tif .tiff .exr .hdr); the error
/// (ErrorCode::usage) lists them.
Result<void> check_picture_name(const std::filesystem::path& path);

/// The depth a format stores by nature: u8 for .png .jpg .tif, half for .exr, f32 for .hdr.
SampleDepth natural_depth(const std::filesystem::path& path);

/// Starts loading the codec in the background; returns at once. Never needed, only faster.
void preload_picture_codec();

/// Reads any picture the codec knows. 8-bit files give u8 samples, all others f32. 1 to 4 channels.
/// Fails (ErrorCode::load) naming the file and what is wrong with it.
Result<Image> read_picture(const std::filesystem::path& path);

/// Writes whole or not at all (ErrorCode::write). PNG: RGB where the picture has an alpha of all ones
/// or none asked for, compression level 1. f32 samples are clamped to 0..1 for integer depths, NaN as 0.
Result<void> write_picture(const std::filesystem::path& path, const Image& image, const PictureFormat& format);

} // namespace tidemark::image
