// A texture one can draw into, and the way its pixels come back.
#pragma once

#include "gl/texture.hpp"

#include <optional>
#include <span>

namespace tidemark::gl {

struct RenderTarget {
    Texture texture;
    FramebufferHandle framebuffer;

    Extent extent() const { return texture.extent; }
};

/// Cleared to zero. Nothing when the driver cannot draw into such a texture (or has no memory for it).
std::optional<RenderTarget> make_render_target(Extent extent, GLenum internal_format);

/// Copies the target's pixels, bottom row first, tightly packed; waits for the drawing to end. `pixels` must
/// hold the whole target.
void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels);

/// Shows the target in the window's own framebuffer, stretched to fill it when their sizes differ.
void blit_to_window(const RenderTarget& target, Extent window);

} // namespace tidemark::gl
