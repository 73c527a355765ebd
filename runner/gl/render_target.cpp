#include "gl/render_target.hpp"

#include <algorithm>
#include <cassert>

namespace tidemark::gl {

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

} // namespace tidemark::gl
