#include "gl/capabilities.hpp"

#include "base/processor.hpp"
#include "base/software_renderer.hpp"

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
    const std::string renderer = text_of(GL_RENDERER);
    return {text_of(GL_VENDOR), renderer, text_of(GL_VERSION), std::min({texture, viewport[0], viewport[1]}),
            is_software_renderer(renderer) ? processor_maker() : ""};
}

std::vector<std::string> query_extensions() {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    std::vector<std::string> names;
    for (GLint i = 0; i < count; ++i)
        names.emplace_back(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))));
    return names;
}

} // namespace tidemark::gl
