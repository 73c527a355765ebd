// Copies of whole pictures by the driver's blit: into the window or into another target.
#pragma once

#include "gl/render_target.hpp"

#include <optional>

namespace tidemark::gl {

/// Draws the target into the default framebuffer, centred and as large as its proportions allow; the rest is
/// black.
void blit_fitted(const RenderTarget& target, Extent window);

/// Returns a copy of the target as RGBA8, which is what a window shows; nothing when there is no memory for
/// it.
std::optional<RenderTarget> copy_in_bytes(const RenderTarget& target);

/// Wraps a texture that was drawn in another context. Contexts share textures but not framebuffers.
RenderTarget attach(Texture texture);

} // namespace tidemark::gl
