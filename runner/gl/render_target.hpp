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

/// Cleared to zero, all its levels too. Nothing when the driver cannot draw into such a texture (or has no
/// memory for it).
std::optional<RenderTarget> make_render_target(Texture texture);

/// Makes `face` of a cube the one that is drawn into and read back.
void select_face(const RenderTarget& target, int face);

void clear(const RenderTarget& target);

/// Copies the overlap of the two from the bottom left corner, pixel for pixel; of cubes, all faces. They have
/// one format, and may come from two contexts that share their textures.
void copy_overlap(const RenderTarget& from, const RenderTarget& to);

/// Copies the target's pixels, bottom row first, tightly packed; waits for the drawing to end. `pixels` must
/// hold the whole target (the selected face of a cube).
void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels);

/// As read_pixels, of the rectangle of that size in the target's bottom left corner, into rows that lie
/// `row_length` pixels apart.
void read_corner(const RenderTarget& target, Extent size, GLenum format, GLenum type, int row_length,
                 std::byte* pixels);

/// Makes the window's own framebuffer black.
void clear_window();

/// Shows the target in the window's own framebuffer, stretched to fill it when their sizes differ. That one
/// is drawn into from then on.
void blit_to_window(const RenderTarget& target, Extent window);

} // namespace tidemark::gl
