// JPEG files by libturbojpeg.
#pragma once

#include "base/extent.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace tidemark::serve {

/// ServePlugIn::encode.
std::string encode_jpeg(Extent extent, std::span<const std::byte> rgba, int quality);

} // namespace tidemark::serve
