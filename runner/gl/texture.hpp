// Creates, fills and reads 2-D, 3-D and cube textures, and creates samplers.
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

/// Allocates storage without content. `levels` 0 stands for a full mipmap chain.
Texture make_texture(Extent extent, GLenum internal_format, int levels);
Texture make_cube_texture(int side, GLenum internal_format, int levels);
Texture make_volume_texture(Extent extent, int depth, GLenum internal_format, int levels);

/// Returns width, height and layers of a level; a cube has six layers at each.
std::array<int, 3> level_size(const Texture& texture, int level);

/// Reads a level as RGBA floats, row by row, one face or slice after the other.
std::vector<float> read_level(const Texture& texture, int level);

/// Reads a part of level 0 as RGBA floats, bottom row first (`layer`: a cube's face, a volume's slice). Waits
/// for drawing into the texture. The part must lie within the texture.
std::vector<float> read_part(const Texture& texture, int layer, const Rectangle& part);

/// Returns whether the driver had memory for the texture. A texture without storage reads as black.
bool has_storage(const Texture& texture);

/// Fills level 0 from tightly packed rows, row 0 first (`layer`: a cube's face, a volume's slice). Does not
/// change other levels: see `make_mipmaps`.
void upload(const Texture& texture, int layer, GLenum format, GLenum type, std::span<const std::byte> pixels);

/// Returns the texture's size in the driver's memory, all levels included.
size_t bytes_of(const Texture& texture);

/// Computes the other levels, if any, from level 0.
void make_mipmaps(const Texture& texture);

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap);

} // namespace tidemark::gl
