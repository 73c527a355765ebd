// Two-dimensional textures and samplers.
#pragma once

#include "base/extent.hpp"
#include "gl/handle.hpp"

#include <cstddef>
#include <span>

namespace tidemark::gl {

struct Texture {
    TextureHandle handle;
    Extent extent;
    GLenum internal_format = 0;
    int levels = 0;

    GLuint id() const { return handle.id(); }
};

/// Storage without content. `levels` 0 stands for a full chain of mipmaps.
Texture make_texture(Extent extent, GLenum internal_format, int levels);

/// Fills level 0 from tightly packed rows, bottom row first, and makes the other levels from it.
void upload(const Texture& texture, GLenum format, GLenum type, std::span<const std::byte> pixels);

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap);

} // namespace tidemark::gl
