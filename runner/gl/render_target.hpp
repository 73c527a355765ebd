// A texture with a framebuffer: is drawn into, copied and read back.
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

/// Attaches the texture to a framebuffer and clears all its levels to zero. Returns nothing when the driver
/// cannot draw into such a texture or has no memory for it.
std::optional<RenderTarget> make_render_target(Texture texture);

/// Selects the face of a cube that is drawn into and read back.
void select_face(const RenderTarget& target, int face);

void clear(const RenderTarget& target);

/// Copies the overlap, aligned at the bottom left corner, pixel for pixel; of cubes, all faces. Both must
/// have the same format; they may belong to two contexts that share textures.
void copy_overlap(const RenderTarget& from, const RenderTarget& to);

/// Copies the target's pixels, bottom row first, tightly packed, after waiting for the drawing to end.
/// `pixels` must hold the whole target (the selected face of a cube).
void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels);

/// Copies the rectangle of that size in the target's bottom left corner, with rows `row_length` pixels apart;
/// else like read_pixels.
void read_corner(const RenderTarget& target, Extent size, GLenum format, GLenum type, int row_length,
                 std::byte* pixels);

/// Fills the default framebuffer with black.
void clear_window();

/// Draws the target into the default framebuffer, stretched to fill it when the sizes differ. Leaves that
/// framebuffer bound for drawing.
void blit_to_window(const RenderTarget& target, Extent window);

} // namespace tidemark::gl
