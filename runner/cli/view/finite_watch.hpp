// Checks at intervals whether all pixels on show are finite. After it has found one that is not, it stops
// until the scene's text changes.
#pragma once

#include "render/renderer.hpp"

#include <cstddef>

namespace tidemark::cli {

/// The caller passes the time, in seconds.
class FiniteWatch {
public:
    /// Starts again, for a changed text.
    void begin_anew();
    void frame_drawn() { unseen_ = true; }

    /// Returns the time of the next `look`; infinity: none is due.
    double due() const;
    /// Checks the last drawn frame, waiting for it. Returns the number of its pixels that are not finite.
    size_t look(const render::Renderer& renderer, double now);

    /// Returns the number in the first picture that had any; 0: none yet.
    size_t found() const { return found_; }

private:
    double next_ = 0;
    bool unseen_ = false; ///< a frame was drawn since the last look
    size_t found_ = 0;
};

} // namespace tidemark::cli
