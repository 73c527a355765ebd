#include "gl/capabilities.hpp"

#include <GL/glcorearb.h>

#include <algorithm>

namespace tidemark::gl {
namespace {

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

} // namespace

Capabilities query_capabilities() {
    GLint texture = 0;
    GLint viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return {text_of(GL_VENDOR), text_of(GL_RENDERER), text_of(GL_VERSION),
            std::min({texture, viewport[0], viewport[1]})};
}

} // namespace tidemark::gl
