// Reads the metadata back that Tidemark wrote into a picture (PictureFormat::metadata).
#pragma once

#include <tl/expected.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::image {

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Reads the metadata of a whole file; empty if there is none. Checks the file as `read_picture` does before
/// decoding. The error is the reason alone, in one line.
tl::expected<Metadata, std::string> read_metadata(const std::filesystem::path& path);

/// Returns the first value of that name; null if there is none.
const std::string* find(const Metadata& metadata, std::string_view name);

} // namespace tidemark::image
