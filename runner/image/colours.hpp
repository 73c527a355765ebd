// The samples of a picture but for its alpha.
#pragma once

#include "image/image.hpp"

#include <cstddef>

namespace tidemark::image {

/// Of row `y`, bit by bit, of an image that has alpha.
void copy_colours(const Image& image, int y, std::byte* to);

} // namespace tidemark::image
