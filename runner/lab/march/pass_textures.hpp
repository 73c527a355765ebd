// Reads back the textures of a pass from the device.
#pragma once

#include "ir/texels.hpp"
#include "render/renderer.hpp"

namespace tidemark::lab {

/// Returns the textures as the last frame left them, by sampler name. Those of the previous frame (no longer
/// available) and those of over 8 million texels are left out, so their values are unknown.
ir::TextureSet textures_of(const render::Renderer& renderer, size_t pass);

} // namespace tidemark::lab
