// Copies the samples of a picture without its alpha.
#pragma once

#include "image/image.hpp"

#include <cstddef>

namespace tidemark::image {

/// Copies the colours of row `y`, bit by bit. The image must have alpha.
void copy_colours(const Image& image, int y, std::byte* to);

} // namespace tidemark::image
