// Encodes JPEG files with libturbojpeg.
#pragma once

#include "base/extent.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace tidemark::serve {

/// Implements ServePlugIn::encode.
std::string encode_jpeg(Extent extent, std::span<const std::byte> rgba, int quality);

} // namespace tidemark::serve
