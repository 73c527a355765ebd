// A texture that a scene draws or reads, as the overlay shows it.
#pragma once

#include "base/extent.hpp"

#include <optional>
#include <string>

namespace tidemark::live {

struct PictureField {
    std::string name;                     ///< "Buffer A", "Image iChannel0"
    unsigned texture = 0;                 ///< OpenGL's, of two dimensions
    Extent extent;                        ///< of that
    std::string size{};                   ///< of what it shows: `64x32`, `6 of 1024x1024`, `32x32x32`
    int slices = 1;                       ///< of a volume
    std::optional<double> milliseconds{}; ///< of drawing it
};

} // namespace tidemark::live
