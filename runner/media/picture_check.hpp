// Checks a picture file's bytes before decoding: its format, whether it is complete, and the size in its
// header. This is needed because the codec's libraries allocate gigabytes for a damaged header, silently fill
// half a JPEG with grey, and print to stderr. Does not decode.
#pragma once

#include "media/plugin/picture_codec.hpp"

#include <tl/expected.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

// Reads the metadata back that Tidemark wrote into a picture (PictureFormat::metadata).

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Reads the metadata of a whole file; empty if there is none. Checks the file as `read_picture` does before
/// decoding. The error is the reason alone, in one line.
tl::expected<Metadata, std::string> read_metadata(const std::filesystem::path& path);

/// Returns the first value of that name; null if there is none.
const std::string* find(const Metadata& metadata, std::string_view name);

} // namespace tidemark::image
