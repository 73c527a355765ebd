// Frames that are drawn and whose pixels are on their way back, while the next one is drawn. The driver is at
// work meanwhile, and so are the encoders.
#pragma once

#include "cli/capture/drawn_frame.hpp"
#include "cli/capture/watchdog.hpp"
#include "gl/pixel_ring.hpp"
#include "render/renderer.hpp"

#include <deque>
#include <optional>
#include <string_view>

namespace tidemark::cli {

class FramesAhead {
public:
    /// Whether it gains anything where that renderer draws. The variable TIDEMARK_READ_BACK decides instead
    /// where it is `ahead` or `at-once`.
    static bool pays(std::string_view renderer);

    /// `renderer` and `dog` must outlive it. `limit`: seconds for a frame.
    FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit);

    bool empty() const { return ring_.empty(); }
    bool full() const { return ring_.full(); }

    /// The frame that was just drawn; its work was begun then. False where the driver has no memory for it.
    bool add(const FrameRecord& record, Watchdog::Clock::time_point begun);
    /// The oldest; waits for it.
    DrawnFrame take();

private:
    struct Waiting {
        FrameRecord record;
        Watchdog::Clock::time_point begun;
    };

    const render::Renderer& renderer_;
    Watchdog& dog_;
    std::optional<double> limit_;
    gl::PixelRing ring_;
    std::deque<Waiting> waiting_;
    Watchdog::Clock::time_point last_taken_; ///< what is behind it was not begun earlier, whoever waited
};

} // namespace tidemark::cli
