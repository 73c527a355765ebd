// Reads frames back asynchronously: the pixels of earlier frames are copied while the driver draws the next
// one and the encoders work.
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
    /// Returns true if reading ahead is faster with this renderer. The environment variable
    /// TIDEMARK_READ_BACK overrides it with `ahead` or `at-once`.
    static bool pays(std::string_view renderer);

    /// `renderer` and `dog` must outlive it. `limit`: seconds for a frame.
    FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit);

    bool empty() const { return ring_.empty(); }
    bool full() const { return ring_.full(); }

    /// Adds the frame that was just drawn, whose work began at `begun`. Returns false if the driver has no
    /// memory for it.
    bool add(const FrameRecord& record, Watchdog::Clock::time_point begun);
    /// Returns the oldest frame; waits for it.
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
    /// The time of a later frame counts from here at the earliest, so that waiting for an earlier one is not
    /// included.
    Watchdog::Clock::time_point last_taken_;
};

} // namespace tidemark::cli
