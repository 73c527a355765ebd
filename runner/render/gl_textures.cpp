#include "render/gl_textures.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

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

Rectangle fitted(Extent picture, Extent window) {
    const double scale =
        std::min(double(window.width) / picture.width, double(window.height) / picture.height);
    const Extent size{int(std::lround(picture.width * scale)), int(std::lround(picture.height * scale))};
    return {(window.width - size.width) / 2, (window.height - size.height) / 2, size};
}

} // namespace

VertexArrayHandle make_vertex_array() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return VertexArrayHandle(id);
}

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

std::optional<RenderTarget> make_render_target(Texture texture) {
    RenderTarget target{std::move(texture), {}};
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    target.framebuffer = FramebufferHandle(id);
    if (target.texture.target == GL_TEXTURE_CUBE_MAP)
        select_face(target, 0);
    else
        glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, target.texture.id(), 0);
    if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return std::nullopt;
    while (glGetError() != GL_NO_ERROR) { // an older error is not about this target
    }
    clear(target);
    if (glGetError() != GL_NO_ERROR)
        return std::nullopt;
    return target;
}

void select_face(const RenderTarget& target, int face) {
    glNamedFramebufferTextureLayer(target.framebuffer.id(), GL_COLOR_ATTACHMENT0, target.texture.id(), 0,
                                   face);
}

void clear(const RenderTarget& target) {
    for (int level = 0; level < target.texture.levels; ++level)
        glClearTexImage(target.texture.id(), level, GL_RGBA, GL_FLOAT, nullptr);
}

void copy_overlap(const RenderTarget& from, const RenderTarget& to) {
    const int width = std::min(from.extent().width, to.extent().width);
    const int height = std::min(from.extent().height, to.extent().height);
    glCopyImageSubData(from.texture.id(), from.texture.target, 0, 0, 0, 0, to.texture.id(), to.texture.target,
                       0, 0, 0, 0, width, height, from.texture.depth);
}

void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels) {
    assert(pixels.size() >= target.extent().pixels());
    read_corner(target, target.extent(), format, type, target.extent().width, pixels.data());
}

void read_corner(const RenderTarget& target, Extent size, GLenum format, GLenum type, int row_length,
                 std::byte* pixels) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, row_length);
    glReadPixels(0, 0, size.width, size.height, format, type, pixels);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

void clear_window() {
    const GLfloat black[] = {0, 0, 0, 1};
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glClearBufferfv(GL_COLOR, 0, black);
}

void blit_to_window(const RenderTarget& target, Extent window) {
    const Extent from = target.extent();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitNamedFramebuffer(target.framebuffer.id(), 0, 0, 0, from.width, from.height, 0, 0, window.width,
                           window.height, GL_COLOR_BUFFER_BIT, from == window ? GL_NEAREST : GL_LINEAR);
}

void blit_fitted(const RenderTarget& target, Extent window) {
    clear_window();
    const Extent from = target.extent();
    const Rectangle to = fitted(from, window);
    glBlitNamedFramebuffer(target.framebuffer.id(), 0, 0, 0, from.width, from.height, to.x, to.y,
                           to.x + to.extent.width, to.y + to.extent.height, GL_COLOR_BUFFER_BIT,
                           from == to.extent ? GL_NEAREST : GL_LINEAR);
}

std::optional<RenderTarget> copy_in_bytes(const RenderTarget& target) {
    const Extent size = target.extent();
    auto copy = make_render_target(make_texture(size, GL_RGBA8, 1));
    if (copy)
        glBlitNamedFramebuffer(target.framebuffer.id(), copy->framebuffer.id(), 0, 0, size.width, size.height,
                               0, 0, size.width, size.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return copy;
}

RenderTarget attach(Texture texture) {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, texture.id(), 0);
    return {std::move(texture), FramebufferHandle(id)};
}

} // namespace tidemark::gl
