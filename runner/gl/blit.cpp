#include "gl/blit.hpp"

#include "base/rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::gl {
namespace {

Rectangle fitted(Extent picture, Extent window) {
    const double scale =
        std::min(double(window.width) / picture.width, double(window.height) / picture.height);
    const Extent size{int(std::lround(picture.width * scale)), int(std::lround(picture.height * scale))};
    return {(window.width - size.width) / 2, (window.height - size.height) / 2, size};
}

} // namespace

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
