#include "gl/texture.hpp"

#include <algorithm>
#include <bit>

namespace tidemark::gl {
namespace {

Texture new_texture(GLenum target, Extent extent, int depth, GLenum internal_format, int levels) {
    const int longest = std::max({extent.width, extent.height, target == GL_TEXTURE_3D ? depth : 1});
    if (levels == 0)
        levels = int(std::bit_width(unsigned(longest)));
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    if (target == GL_TEXTURE_3D)
        glTextureStorage3D(id, levels, internal_format, extent.width, extent.height, depth);
    else
        glTextureStorage2D(id, levels, internal_format, extent.width, extent.height);
    return {TextureHandle(id), target, extent, depth, internal_format, levels};
}

} // namespace

Texture make_texture(Extent extent, GLenum internal_format, int levels) {
    return new_texture(GL_TEXTURE_2D, extent, 1, internal_format, levels);
}

Texture make_cube_texture(int side, GLenum internal_format, int levels) {
    return new_texture(GL_TEXTURE_CUBE_MAP, {side, side}, 6, internal_format, levels);
}

Texture make_volume_texture(Extent extent, int depth, GLenum internal_format, int levels) {
    return new_texture(GL_TEXTURE_3D, extent, depth, internal_format, levels);
}

std::array<int, 3> level_size(const Texture& texture, int level) {
    const auto halved = [level](int size) { return std::max(1, size >> level); };
    return {halved(texture.extent.width), halved(texture.extent.height),
            texture.target == GL_TEXTURE_3D ? halved(texture.depth) : texture.depth};
}

std::vector<float> read_level(const Texture& texture, int level) {
    const auto [width, height, layers] = level_size(texture, level);
    std::vector<float> rgba(size_t(width) * size_t(height) * size_t(layers) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), level, GL_RGBA, GL_FLOAT, GLsizei(rgba.size() * sizeof(float)),
                      rgba.data());
    return rgba;
}

bool has_storage(const Texture& texture) {
    GLint immutable = 0; // set by a successful glTextureStorage
    glGetTextureParameteriv(texture.id(), GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    return immutable != 0;
}

void upload(const Texture& texture, int layer, GLenum format, GLenum type,
            std::span<const std::byte> pixels) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const Extent extent = texture.extent;
    if (texture.target == GL_TEXTURE_2D)
        glTextureSubImage2D(texture.id(), 0, 0, 0, extent.width, extent.height, format, type, pixels.data());
    else
        glTextureSubImage3D(texture.id(), 0, 0, 0, layer, extent.width, extent.height, 1, format, type,
                            pixels.data());
}

std::vector<float> read_part(const Texture& texture, int layer, const Rectangle& part) {
    std::vector<float> values(part.extent.pixels() * 4);
    glGetTextureSubImage(texture.id(), 0, part.x, part.y, layer, part.extent.width, part.extent.height, 1,
                         GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(float)), values.data());
    return values;
}

size_t bytes_of(const Texture& texture) {
    GLint bits = 0;
    for (const GLenum part :
         {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE}) {
        GLint size = 0;
        glGetTextureLevelParameteriv(texture.id(), 0, part, &size);
        bits += size;
    }
    size_t texels = 0;
    for (int level = 0; level < texture.levels; ++level) {
        const int depth = texture.target == GL_TEXTURE_3D ? texture.depth >> level : texture.depth;
        texels += size_t(std::max(1, texture.extent.width >> level)) *
                  size_t(std::max(1, texture.extent.height >> level)) * size_t(std::max(1, depth));
    }
    return texels * size_t(bits) / 8;
}

void make_mipmaps(const Texture& texture) {
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
