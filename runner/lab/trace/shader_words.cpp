#include "lab/trace/shader_words.hpp"

#include "glsl/instrument/watch.hpp"

namespace tidemark::lab {

ShaderWords::ShaderWords(size_t count) : count_(count) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer_ = gl::BufferHandle(id);
    const std::vector<uint32_t> zeros(count);
    glNamedBufferStorage(id, GLsizeiptr(count * sizeof(uint32_t)), zeros.data(), 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, glsl::k_watch_binding, id);
}

std::vector<uint32_t> ShaderWords::read() const {
    std::vector<uint32_t> words(count_);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer_.id(), 0, GLsizeiptr(count_ * sizeof(uint32_t)), words.data());
    return words;
}

} // namespace tidemark::lab
