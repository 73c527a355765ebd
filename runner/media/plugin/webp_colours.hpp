// Restores the colours of a WebP with alpha, which OpenImageIO (2.4) always multiplies by alpha.
#pragma once

#include "media/image.hpp"

#include <span>

namespace tidemark::image {

/// Replaces the colours of `decoded`, OpenImageIO's bytes with alpha, by those of the file. For an animation,
/// which libwebp's simple functions cannot read, divides them by alpha again, as exactly as eight-bit
/// products allow.
void restore_colours(std::span<const std::byte> file, Image& decoded);

} // namespace tidemark::image
