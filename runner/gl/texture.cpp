#include "gl/texture.hpp"

#include <algorithm>
#include <bit>

namespace tidemark::gl {

Texture make_texture(Extent extent, GLenum internal_format, int levels) {
    if (levels == 0)
        levels = int(std::bit_width(unsigned(std::max(extent.width, extent.height))));
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &id);
    glTextureStorage2D(id, levels, internal_format, extent.width, extent.height);
    return {TextureHandle(id), extent, internal_format, levels};
}

void upload(const Texture& texture, GLenum format, GLenum type, std::span<const std::byte> pixels) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.id(), 0, 0, 0, texture.extent.width, texture.extent.height, format, type,
                        pixels.data());
    if (texture.levels > 1)
        glGenerateTextureMipmap(texture.id());
}

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GLint(minify));
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GLint(magnify));
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glSamplerParameteri(id, axis, GLint(wrap));
    return SamplerHandle(id);
}

} // namespace tidemark::gl
