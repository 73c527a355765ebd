// The state that a scene carries from one frame to the next: the pictures of the passes that the next frame
// reads.
#pragma once

#include <string>
#include <vector>

namespace tidemark::render {

/// RGBA, row by row from the bottom; of a cube, one face after the other.
using TextureFloats = std::vector<float>;

struct PassState {
    std::string pass;
    std::vector<TextureFloats> textures{}; ///< newest first
};

using BufferState = std::vector<PassState>;

} // namespace tidemark::render
