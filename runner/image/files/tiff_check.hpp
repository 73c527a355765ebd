// Whether all that a TIFF's directory speaks of is in the file: libtiff paints what is missing black without
// a word. Classic and BigTIFF, in either byte order. No decoding.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// What is wrong with the file, or nothing.
std::optional<std::string> tiff_objection(std::string_view file);

} // namespace tidemark::image
