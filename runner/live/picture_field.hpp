// A texture that a scene draws or reads, as the overlay shows it.
#pragma once

#include "base/extent.hpp"

#include <optional>
#include <string>

namespace tidemark::live {

struct PictureField {
    std::string name;                     ///< "Buffer A", "Image iChannel0"
    unsigned texture = 0;                 ///< name of a two-dimensional OpenGL texture
    Extent extent;                        ///< of that texture
    std::string size{};                   ///< of the source: `64x32`, `6 of 1024x1024`, `32x32x32`
    int slices = 1;                       ///< of a volume; else 1
    std::optional<double> milliseconds{}; ///< time to draw it
};

} // namespace tidemark::live
