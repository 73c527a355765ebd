// The colours of a WebP with alpha, which OpenImageIO (2.4) multiplies by it whatever it is asked for.
#pragma once

#include "image/image.hpp"

#include <span>

namespace tidemark::image {

/// `decoded`: what OpenImageIO made of the file, bytes with alpha. Its colours become those of the file; of
/// an animation, which libwebp's simple functions do not read, they are divided by alpha again, as exact as
/// eight bits of a product are.
void restore_colours(std::span<const std::byte> file, Image& decoded);

} // namespace tidemark::image
