#include "render/gl_sync.hpp"

#include "render/gl_context.hpp"

#include <cassert>
#include <limits>

namespace tidemark::gl {

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
    glFlush();
}

/// A fence that cannot be waited for, for example in a lost context, counts as passed.
bool Fence::wait(double seconds) const {
    return glClientWaitSync(sync_.get(), 0, GLuint64(seconds * 1e9)) != GL_TIMEOUT_EXPIRED;
}

namespace {

/// Returns no query in OpenGL ES.
QueryHandle create_query() {
    GLuint id = 0;
    if (is_es())
        return {};
    glCreateQueries(GL_TIME_ELAPSED, 1, &id);
    return QueryHandle(id);
}

} // namespace

ElapsedTime::ElapsedTime() : query_(create_query()) {
    if (query_.id() != 0)
        glBeginQuery(GL_TIME_ELAPSED, query_.id());
}

void ElapsedTime::stop() {
    if (query_.id() != 0)
        glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> ElapsedTime::milliseconds() const {
    if (query_.id() == 0)
        return std::nullopt;
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0)
        return std::nullopt;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
}

size_t PixelRing::bytes() const {
    size_t sum = 0;
    for (const Buffer& buffer : buffers_)
        sum += buffer.mapped.size();
    return sum;
}

/// Maps the buffer persistently, so that taking a picture calls the driver for the fence only.
bool PixelRing::make_room(Buffer& buffer, size_t bytes) const {
    if (buffer.mapped.size() == bytes)
        return true;
    while (glGetError() != GL_NO_ERROR) { // an older error is not about this buffer
    }
    buffer = {};
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer.handle = BufferHandle(id);
    constexpr GLbitfield k_access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glNamedBufferStorage(id, GLsizeiptr(bytes), nullptr, k_access | GL_CLIENT_STORAGE_BIT);
    const void* const mapped =
        glGetError() == GL_NO_ERROR ? glMapNamedBufferRange(id, 0, GLsizeiptr(bytes), k_access) : nullptr;
    if (!mapped)
        return false;
    buffer.mapped = {static_cast<const std::byte*>(mapped), bytes};
    return true;
}

bool PixelRing::read(const RenderTarget& target, Extent size, GLenum format, GLenum type, size_t bytes) {
    assert(!full());
    Buffer& buffer = buffers_[next_];
    if (target.texture.es || !make_room(buffer, bytes))
        return false;
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer.handle.id());
    read_corner(target, size, format, type, 0, nullptr);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    waiting_.emplace_back();
    next_ = (next_ + 1) % buffers_.size();
    return true;
}

std::span<const std::byte> PixelRing::take() {
    assert(!empty());
    const size_t oldest = (next_ + buffers_.size() - waiting_.size()) % buffers_.size();
    waiting_.front().wait(std::numeric_limits<int>::max());
    waiting_.pop_front();
    return buffers_[oldest].mapped;
}

} // namespace tidemark::gl
