// Waiting for the GPU: fences, timers, asynchronous read-back.
//
// Tests whether the driver has finished all commands up to a point.
#pragma once

#include "render/gl_textures.hpp"

#include <GL/glcorearb.h>

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tidemark::gl {

class Fence {
public:
    /// Inserts a fence after the commands issued so far and flushes them.
    Fence();

    /// Waits up to that many seconds; returns whether the commands are finished. 0 only tests.
    bool wait(double seconds) const;

private:
    struct Delete {
        void operator()(GLsync sync) const { glDeleteSync(sync); }
    };
    std::unique_ptr<__GLsync, Delete> sync_;
};

// Measures GPU time with the driver's timer (GL_TIME_ELAPSED). The timer may be wrong: users compare it with
// a wall clock, as a study of the lab does.

/// Runs from construction to `stop`; a context can run one at a time. OpenGL ES has no such timer.
class ElapsedTime {
public:
    ElapsedTime();

    void stop();
    /// Waits for the measured commands. Returns nothing when the driver has no such timer.
    std::optional<double> milliseconds() const;

private:
    QueryHandle query_;
};

// Asynchronous read-back: the GPU copies each picture into its own buffer and goes on with the next frame.
// Pictures are taken in the order of the reads.

class PixelRing {
public:
    /// `depth`: the largest number of pictures in flight. Each buffer is allocated at its first read.
    explicit PixelRing(size_t depth) : buffers_(depth) {}

    bool empty() const { return waiting_.empty(); }
    bool full() const { return waiting_.size() == buffers_.size(); }
    /// Returns the bytes of all buffers allocated so far.
    size_t bytes() const;

    /// Starts to copy the rectangle of that size in the target's bottom left corner: rows from the bottom,
    /// tightly packed, `bytes` in all. The ring must not be full. Returns false when the driver has no memory
    /// for it, and with OpenGL ES, which cannot keep a buffer mapped.
    bool read(const RenderTarget& target, Extent size, GLenum format, GLenum type, size_t bytes);

    /// Returns whether the oldest picture has arrived.
    bool ready() const { return waiting_.front().wait(0); }
    /// Waits for the oldest picture and returns it; valid until the next `read`. The ring must not be empty.
    std::span<const std::byte> take();

private:
    struct Buffer {
        BufferHandle handle;
        std::span<const std::byte> mapped{}; ///< valid as long as the buffer exists
    };
    bool make_room(Buffer& buffer, size_t bytes) const;

    std::vector<Buffer> buffers_;
    std::deque<Fence> waiting_; ///< one per buffer before `next_`, oldest first
    size_t next_ = 0;
};

} // namespace tidemark::gl
