// Textures, samplers and framebuffers. OpenGL 4.5 changes objects by their names; OpenGL ES changes the
// object that is bound.
#include "render/gl_textures.hpp"

#include "render/gl_context.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace tidemark::gl {

bool holds_bytes(GLenum internal_format) {
    return internal_format == GL_R8 || internal_format == GL_RG8 || internal_format == GL_RGB8 ||
           internal_format == GL_RGBA8;
}

namespace {

/// The unit for textures that are changed in OpenGL ES; channels use the units from 0 to 10.
constexpr GLuint k_edit_unit = 15;

void bind_to_edit(GLenum target, GLuint texture) {
    glActiveTexture(GL_TEXTURE0 + k_edit_unit);
    glBindTexture(target, texture);
}

/// Returns the target of one face of a cube, or the texture's own.
GLenum target_of_layer(const Texture& texture, int layer) {
    return texture.target == GL_TEXTURE_CUBE_MAP ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + layer)
                                                 : texture.target;
}

/// Attaches a level's layer to a framebuffer and leaves it bound, in OpenGL ES.
void attach_bound(GLenum where, GLuint framebuffer, const Texture& texture, int level, int layer) {
    glBindFramebuffer(where, framebuffer);
    if (texture.target == GL_TEXTURE_3D)
        glFramebufferTextureLayer(where, GL_COLOR_ATTACHMENT0, texture.id(), level, layer);
    else
        glFramebufferTexture2D(where, GL_COLOR_ATTACHMENT0, target_of_layer(texture, layer), texture.id(),
                               level);
}

FramebufferHandle new_framebuffer() {
    GLuint id = 0;
    if (is_es())
        glGenFramebuffers(1, &id);
    else
        glCreateFramebuffers(1, &id);
    return FramebufferHandle(id);
}

/// Reads RGBA from the framebuffer that is bound for reading. OpenGL ES reads bytes from formats of bytes and
/// floats from formats of floats only, so the samples are converted here.
void read_bound(GLenum internal_format, const Rectangle& part, GLenum type, int row_length,
                std::byte* pixels) {
    const bool bytes = holds_bytes(internal_format);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    if (bytes == (type == GL_UNSIGNED_BYTE)) {
        glPixelStorei(GL_PACK_ROW_LENGTH, row_length);
        glReadPixels(part.x, part.y, part.extent.width, part.extent.height, GL_RGBA, type, pixels);
        glPixelStorei(GL_PACK_ROW_LENGTH, 0);
        return;
    }
    const size_t row = size_t(part.extent.width) * 4, step = size_t(row_length) * 4;
    if (bytes) {
        std::vector<uint8_t> read(row * size_t(part.extent.height));
        glReadPixels(part.x, part.y, part.extent.width, part.extent.height, GL_RGBA, GL_UNSIGNED_BYTE,
                     read.data());
        auto* const into = reinterpret_cast<float*>(pixels);
        for (size_t i = 0; i < read.size(); ++i)
            into[i / row * step + i % row] = float(read[i]) / 255;
        return;
    }
    std::vector<float> read(row * size_t(part.extent.height));
    glReadPixels(part.x, part.y, part.extent.width, part.extent.height, GL_RGBA, GL_FLOAT, read.data());
    auto* const into = reinterpret_cast<uint8_t*>(pixels);
    for (size_t i = 0; i < read.size(); ++i)
        into[i / row * step + i % row] =
            uint8_t(std::lround(255 * (read[i] > 0 ? std::min(read[i], 1.0F) : 0.0F))); // NaN is 0
}

std::vector<float> read_layer(const Texture& texture, int level, int layer, const Rectangle& part) {
    std::vector<float> values(part.extent.pixels() * 4);
    const FramebufferHandle framebuffer = new_framebuffer();
    attach_bound(GL_READ_FRAMEBUFFER, framebuffer.id(), texture, level, layer);
    read_bound(texture.internal_format, part, GL_FLOAT, part.extent.width,
               reinterpret_cast<std::byte*>(values.data()));
    return values;
}

/// Fills level 0 of a layer, in OpenGL ES.
void upload_bound(const Texture& texture, int layer, GLenum format, GLenum type, const void* pixels) {
    bind_to_edit(texture.target, texture.id());
    const auto [width, height] = texture.extent;
    if (texture.target == GL_TEXTURE_3D)
        glTexSubImage3D(texture.target, 0, 0, 0, layer, width, height, 1, format, type, pixels);
    else
        glTexSubImage2D(target_of_layer(texture, layer), 0, 0, 0, width, height, format, type, pixels);
}

/// Clears every level and face, in OpenGL ES. A scissor box does not limit it.
void clear_bound(const RenderTarget& target) {
    const GLboolean scissor = glIsEnabled(GL_SCISSOR_TEST);
    glDisable(GL_SCISSOR_TEST);
    constexpr GLfloat k_zero[4] = {};
    for (int face = target.texture.depth; face-- > 0;)
        for (int level = target.texture.levels; level-- > 0;) { // level 0 of face 0 stays attached
            attach_bound(GL_DRAW_FRAMEBUFFER, target.framebuffer.id(), target.texture, level, face);
            glClearBufferfv(GL_COLOR, 0, k_zero);
        }
    if (scissor)
        glEnable(GL_SCISSOR_TEST);
}

/// Copies a rectangle of one framebuffer to another; the second one stays bound for drawing.
void blit(const RenderTarget& picture, GLuint to, const Rectangle& source, const Rectangle& place,
          GLenum filter) {
    const GLuint from = picture.framebuffer.id();
    const int right = source.x + source.extent.width, top = source.y + source.extent.height;
    const int end_x = place.x + place.extent.width, end_y = place.y + place.extent.height;
    if (picture.texture.es) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
        glBlitFramebuffer(source.x, source.y, right, top, place.x, place.y, end_x, end_y, GL_COLOR_BUFFER_BIT,
                          filter);
        return;
    }
    glBlitNamedFramebuffer(from, to, source.x, source.y, right, top, place.x, place.y, end_x, end_y,
                           GL_COLOR_BUFFER_BIT, filter);
}

Texture new_texture(GLenum target, Extent extent, int depth, GLenum internal_format, int levels) {
    const int longest = std::max({extent.width, extent.height, target == GL_TEXTURE_3D ? depth : 1});
    if (levels == 0)
        levels = int(std::bit_width(unsigned(longest)));
    GLuint id = 0;
    if (is_es()) {
        glGenTextures(1, &id);
        bind_to_edit(target, id);
        if (target == GL_TEXTURE_3D)
            glTexStorage3D(target, levels, internal_format, extent.width, extent.height, depth);
        else
            glTexStorage2D(target, levels, internal_format, extent.width, extent.height);
        return {TextureHandle(id), target, extent, depth, internal_format, levels, true};
    }
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
    if (is_es())
        glGenVertexArrays(1, &id);
    else
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
    std::vector<float> rgba;
    if (texture.es) {
        for (int layer = 0; layer < layers; ++layer) {
            const auto part = read_layer(texture, level, layer, {0, 0, {width, height}});
            rgba.insert(rgba.end(), part.begin(), part.end());
        }
        return rgba;
    }
    rgba.resize(size_t(width) * size_t(height) * size_t(layers) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.id(), level, GL_RGBA, GL_FLOAT, GLsizei(rgba.size() * sizeof(float)),
                      rgba.data());
    return rgba;
}

bool has_storage(const Texture& texture) {
    GLint immutable = 0; // set by a successful glTextureStorage
    if (texture.es) {
        bind_to_edit(texture.target, texture.id());
        glGetTexParameteriv(texture.target, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    } else {
        glGetTextureParameteriv(texture.id(), GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    }
    return immutable != 0;
}

void upload(const Texture& texture, int layer, GLenum format, GLenum type,
            std::span<const std::byte> pixels) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const Extent extent = texture.extent;
    if (texture.es)
        upload_bound(texture, layer, format, type, pixels.data());
    else if (texture.target == GL_TEXTURE_2D)
        glTextureSubImage2D(texture.id(), 0, 0, 0, extent.width, extent.height, format, type, pixels.data());
    else
        glTextureSubImage3D(texture.id(), 0, 0, 0, layer, extent.width, extent.height, 1, format, type,
                            pixels.data());
}

std::vector<float> read_part(const Texture& texture, int layer, const Rectangle& part) {
    if (texture.es)
        return read_layer(texture, 0, layer, part);
    std::vector<float> values(part.extent.pixels() * 4);
    glGetTextureSubImage(texture.id(), 0, part.x, part.y, layer, part.extent.width, part.extent.height, 1,
                         GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(float)), values.data());
    return values;
}

void set_swizzle(const Texture& texture, const std::array<GLint, 4>& components) {
    if (!texture.es) {
        glTextureParameteriv(texture.id(), GL_TEXTURE_SWIZZLE_RGBA, components.data());
        return;
    }
    bind_to_edit(texture.target, texture.id());
    for (GLenum i = 0; i < components.size(); ++i)
        glTexParameteri(texture.target, GL_TEXTURE_SWIZZLE_R + i, components[i]);
}

void bind_texture(GLuint unit, const Texture& texture) {
    if (!texture.es) {
        glBindTextureUnit(unit, texture.id());
        return;
    }
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum target : {GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D})
        glBindTexture(target, target == texture.target ? texture.id() : 0);
}

size_t bytes_of(const Texture& texture) {
    GLint bits = 0;
    if (texture.es)
        bind_to_edit(texture.target, texture.id());
    for (const GLenum part :
         {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE}) {
        GLint size = 0;
        if (texture.es)
            glGetTexLevelParameteriv(target_of_layer(texture, 0), 0, part, &size);
        else
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
    if (texture.levels <= 1)
        return;
    if (!texture.es) {
        glGenerateTextureMipmap(texture.id());
        return;
    }
    bind_to_edit(texture.target, texture.id());
    glGenerateMipmap(texture.target);
}

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap) {
    GLuint id = 0;
    if (is_es())
        glGenSamplers(1, &id);
    else
        glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, GLint(minify));
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, GLint(magnify));
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glSamplerParameteri(id, axis, GLint(wrap));
    return SamplerHandle(id);
}

std::optional<RenderTarget> make_render_target(Texture texture) {
    RenderTarget target = attach(std::move(texture));
    const GLuint id = target.framebuffer.id();
    const GLenum status = target.texture.es
                              ? glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) // attach() has bound it
                              : glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return std::nullopt;
    while (glGetError() != GL_NO_ERROR) { // an older error is not about this target
    }
    clear(target);
    if (glGetError() != GL_NO_ERROR)
        return std::nullopt;
    return target;
}

void select_face(const RenderTarget& target, int face) {
    if (target.texture.es)
        return attach_bound(GL_DRAW_FRAMEBUFFER, target.framebuffer.id(), target.texture, 0, face);
    glNamedFramebufferTextureLayer(target.framebuffer.id(), GL_COLOR_ATTACHMENT0, target.texture.id(), 0,
                                   face);
}

void clear(const RenderTarget& target) {
    if (target.texture.es)
        return clear_bound(target);
    for (int level = 0; level < target.texture.levels; ++level)
        glClearTexImage(target.texture.id(), level, GL_RGBA, GL_FLOAT, nullptr);
}

void copy_overlap(const RenderTarget& from, const RenderTarget& to) {
    const int width = std::min(from.extent().width, to.extent().width);
    const int height = std::min(from.extent().height, to.extent().height);
    if (from.texture.es) {
        for (int face = from.texture.depth; face-- > 0;) { // face 0 stays selected
            select_face(from, face);
            select_face(to, face);
            const Rectangle part{0, 0, {width, height}};
            blit(from, to.framebuffer.id(), part, part, GL_NEAREST);
        }
        return;
    }
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
    if (target.texture.es)
        return read_bound(target.texture.internal_format, {0, 0, size}, type,
                          row_length > 0 ? row_length : size.width, pixels);
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
    blit(target, 0, {0, 0, from}, {0, 0, window}, from == window ? GL_NEAREST : GL_LINEAR);
}

void blit_fitted(const RenderTarget& target, Extent window) {
    clear_window();
    const Extent from = target.extent();
    const Rectangle to = fitted(from, window);
    blit(target, 0, {0, 0, from}, to, from == to.extent ? GL_NEAREST : GL_LINEAR);
}

std::optional<RenderTarget> copy_in_bytes(const RenderTarget& target) {
    const Rectangle whole{0, 0, target.extent()};
    auto copy = make_render_target(make_texture(target.extent(), GL_RGBA8, 1));
    if (copy)
        blit(target, copy->framebuffer.id(), whole, whole, GL_NEAREST);
    return copy;
}

RenderTarget attach(Texture texture) {
    RenderTarget target{std::move(texture), new_framebuffer()};
    if (target.texture.es)
        attach_bound(GL_DRAW_FRAMEBUFFER, target.framebuffer.id(), target.texture, 0, 0);
    else if (target.texture.target == GL_TEXTURE_CUBE_MAP)
        select_face(target, 0);
    else
        glNamedFramebufferTexture(target.framebuffer.id(), GL_COLOR_ATTACHMENT0, target.texture.id(), 0);
    return target;
}

} // namespace tidemark::gl
