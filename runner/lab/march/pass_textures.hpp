// The textures that a pass reads, read back from the device.
#pragma once

#include "ir/texels.hpp"
#include "render/renderer.hpp"

namespace tidemark::lab {

/// As the last frame left them, by the names of their samplers. Left out, and so unknown, are what a pass
/// reads of the frame before (it is gone) and what is too large to be kept twice.
ir::TextureSet textures_of(const render::Renderer& renderer, size_t pass);

} // namespace tidemark::lab
