// Looks now and then whether the picture on show is made of numbers: once it was not, no more until another
// text is on show.
#pragma once

#include "render/renderer.hpp"

#include <cstddef>

namespace tidemark::cli {

/// Told the time by its caller, in seconds.
class FiniteWatch {
public:
    /// Another text is on show.
    void begin_anew();
    void frame_drawn() { unseen_ = true; }

    /// When there is something to `look` at; infinity: nothing.
    double due() const;
    /// Looks at the frame that was drawn last, and waits for it. How many of its pixels are not finite.
    size_t look(const render::Renderer& renderer, double now);

    /// In the picture that had the first.
    size_t found() const { return found_; }

private:
    double next_ = 0;
    bool unseen_ = false; ///< a frame was drawn since the last look
    size_t found_ = 0;
};

} // namespace tidemark::cli
