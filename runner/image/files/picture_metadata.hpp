// What we wrote into a picture beside its pixels (PictureFormat::metadata), read back.
#pragma once

#include <tl/expected.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::image {

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Of a whole file: a PNG's checksums are looked at, too, of other formats what `read_picture` looks at
/// before it decodes. The error is the reason alone, in one line; empty where the file holds nothing of ours.
tl::expected<Metadata, std::string> read_metadata(const std::filesystem::path& path);

/// The first value of that name; null where there is none.
const std::string* find(const Metadata& metadata, std::string_view name);

} // namespace tidemark::image
