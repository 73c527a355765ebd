#include "gl/fence.hpp"

namespace tidemark::gl {

Fence::Fence() : sync_(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {
    glFlush();
}

/// A fence that cannot be waited for, for example in a lost context, counts as passed.
bool Fence::wait(double seconds) const {
    return glClientWaitSync(sync_.get(), 0, GLuint64(seconds * 1e9)) != GL_TIMEOUT_EXPIRED;
}

} // namespace tidemark::gl
