// Checks that a TIFF contains all its directories and the data of its first picture, because libtiff silently
// fills missing pixels with black. Handles classic TIFF and BigTIFF in either byte order. Does not decode.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::image {

/// Returns the error, or nothing.
std::optional<std::string> tiff_objection(std::string_view file);

} // namespace tidemark::image
