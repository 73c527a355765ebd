// Textures of two and three dimensions, cubes, and samplers.
#pragma once

#include "base/rectangle.hpp"
#include "gl/handle.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tidemark::gl {

struct Texture {
    TextureHandle handle;
    GLenum target = 0; ///< GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D
    Extent extent;
    int depth = 1; ///< 6 for a cube
    GLenum internal_format = 0;
    int levels = 0;

    GLuint id() const { return handle.id(); }
};

/// Storage without content. `levels` 0 stands for a full chain of mipmaps.
Texture make_texture(Extent extent, GLenum internal_format, int levels);
Texture make_cube_texture(int side, GLenum internal_format, int levels);
Texture make_volume_texture(Extent extent, int depth, GLenum internal_format, int levels);

/// Width, height and layers of a level; a cube has six at each.
std::array<int, 3> level_size(const Texture& texture, int level);

/// A level in floats, RGBA: row by row, one face or slice after the other.
std::vector<float> read_level(const Texture& texture, int level);

/// A part of level 0 in floats, RGBA: its bottom row first (`layer`: a cube's face, a volume's slice). Waits
/// for what draws into it; the part lies within the texture.
std::vector<float> read_part(const Texture& texture, int layer, const Rectangle& part);

/// Whether the driver had room for it. One without reads as black.
bool has_storage(const Texture& texture);

/// Fills level 0 from tightly packed rows, row 0 first (`layer`: a cube's face, a volume's slice). Other
/// levels are left to `make_mipmaps`.
void upload(const Texture& texture, int layer, GLenum format, GLenum type, std::span<const std::byte> pixels);

/// What the driver keeps of it, levels included.
size_t bytes_of(const Texture& texture);

/// Makes all levels from level 0, where there are any.
void make_mipmaps(const Texture& texture);

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap);

} // namespace tidemark::gl
