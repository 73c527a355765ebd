// Looks at a picture file's bytes before the codec does: which format it is, whether it is whole, how large
// the picture says it is. The libraries behind the codec take gigabytes on the word of a damaged header,
// paint a half JPEG grey without a word, and talk on stderr. No codec, no pixels.
#pragma once

#include "image/plugin/picture_codec.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// The format by its first bytes; TGA, which has none of its own, by the path's extension.
std::optional<FileFormat> format_of(std::string_view file, const std::filesystem::path& path);

/// The bytes that the codec should see, or in one line why it should not see any. PNG: every chunk is whole
/// and has its checksum; only those that make samples stay (IHDR PLTE tRNS IDAT IEND), so that neither gamma
/// nor a profile nor a text that unpacks to gigabytes is looked at. JPEG: it has its end. JPEG and EXR: the
/// header is sound. The other formats are passed on.
tl::expected<std::string, std::string> checked_file(FileFormat format, std::string file);

/// Why a picture of this size is not read, or nothing.
std::optional<std::string> size_objection(int64_t width, int64_t height);

} // namespace tidemark::image
