#include "gl/compiler_messages.hpp"

#include <GL/glcorearb.h>

#include <cstring>
#include <utility>

namespace tidemark::gl {
namespace {

void APIENTRY keep(GLenum source, GLenum, GLuint, GLenum, GLsizei length, const GLchar* text,
                   const void* messages) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER)
        static_cast<std::vector<std::string>*>(const_cast<void*>(messages))
            ->emplace_back(text, length < 0 ? std::strlen(text) : size_t(length));
}

} // namespace

CompilerMessages::CompilerMessages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // on this thread, before the compiling call returns
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(keep, &messages_);
}

CompilerMessages::~CompilerMessages() {
    glDebugMessageCallback(nullptr, nullptr);
    glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDisable(GL_DEBUG_OUTPUT);
}

std::vector<std::string> CompilerMessages::take() {
    return std::exchange(messages_, {});
}

} // namespace tidemark::gl
