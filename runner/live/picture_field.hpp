// A texture that a scene draws or reads, as the overlay shows it.
#pragma once

#include "base/extent.hpp"

#include <optional>
#include <string>

namespace tidemark::live {

struct PictureField {
    std::string name;     ///< "Buffer A", "Image iChannel0"
    unsigned texture = 0; ///< OpenGL's, of two dimensions
    Extent extent;
    std::optional<double> milliseconds{}; ///< of drawing it
};

} // namespace tidemark::live
