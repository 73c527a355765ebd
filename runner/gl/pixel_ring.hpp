// Pixels on their way back: the device copies each picture into a buffer of its own behind the drawing, and
// goes on with the next one until it is taken. The oldest is taken first.
#pragma once

#include "gl/fence.hpp"
#include "gl/render_target.hpp"

#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace tidemark::gl {

class PixelRing {
public:
    /// How many pictures may be on their way; their memory is taken when they are first read.
    explicit PixelRing(size_t depth) : buffers_(depth) {}

    bool empty() const { return waiting_.empty(); }
    bool full() const { return waiting_.size() == buffers_.size(); }
    /// Of all buffers so far.
    size_t bytes() const;

    /// Begins to copy the rectangle of that size in the target's bottom left corner: rows from the bottom,
    /// tightly packed, `bytes` in all. The ring is not full. False where the driver has no memory for it.
    bool read(const RenderTarget& target, Extent size, GLenum format, GLenum type, size_t bytes);

    /// Whether the oldest is there already.
    bool ready() const { return waiting_.front().wait(0); }
    /// The oldest, once it is there: until the next `read`. The ring is not empty.
    std::span<const std::byte> take();

private:
    struct Buffer {
        BufferHandle handle;
        std::span<const std::byte> mapped{}; ///< as long as the buffer lives
    };
    bool make_room(Buffer& buffer, size_t bytes) const;

    std::vector<Buffer> buffers_;
    std::deque<Fence> waiting_; ///< of the buffers before `next_`
    size_t next_ = 0;
};

} // namespace tidemark::gl
