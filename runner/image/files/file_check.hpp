// Checks a picture file's bytes before decoding: its format, whether it is complete, and the size in its
// header. This is needed because the codec's libraries allocate gigabytes for a damaged header, silently fill
// half a JPEG with grey, and print to stderr. Does not decode.
#pragma once

#include "image/plugin/picture_codec.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// Returns the format by the first bytes; for TGA, which has no signature, by the path's extension.
std::optional<FileFormat> format_of(std::string_view file, const std::filesystem::path& path);

/// Returns the bytes for the codec, or one line that says why the file is rejected. PNG: every chunk must be
/// complete with a correct checksum; only IHDR PLTE tRNS IDAT IEND are kept, so that gamma, profiles and
/// texts, which may unpack to gigabytes, have no effect. JPEG: must have its end marker. JPEG and EXR: the
/// header must be valid. TIFF: see `tiff_objection`. Other formats are not checked.
tl::expected<std::string, std::string> checked_file(FileFormat format, std::string file);

/// Returns why a picture of this size is rejected, or nothing.
std::optional<std::string> size_objection(int64_t width, int64_t height);

} // namespace tidemark::image
