// What leaving a thing out of a scene saves: the scene without it and with it, interleaved in one run, and
// whether the pixels are the same bytes. A context must be current.
#pragma once

#include "base/result.hpp"
#include "lab/statistics.hpp"
#include "render/renderer.hpp"

#include <span>
#include <string_view>

namespace tidemark::lab {

/// A way of drawing a frame.
struct Way {
    render::RenderOptions options{};
    int frames_before = 0; ///< drawn on the way to the one that is wanted
};

/// A thing that is left out where a scene does not need it.
struct Omission {
    std::string_view name;
    std::string_view what; ///< for people
    void (*put_back)(Way&);
};

std::span<const Omission> omissions();

/// Milliseconds.
struct Saved {
    double without = 0;  ///< median
    double more = 0;     ///< median of what the thing costs in the same round
    Interval interval{}; ///< of `more`
};

struct SavedTime {
    Saved wall;
    Saved cpu;
};

struct Saving {
    render::FrameWork without{};
    render::FrameWork with_it{};
    SavedTime start{}; ///< from the scene to its first frame, the driver's cache warm
    SavedTime frame{};
    bool same_pixels = true;

    /// Putting it back made a difference to measure.
    bool left_out() const { return without != with_it; }
};

/// Puts all of `things` back at once. Takes some `seconds`, more where five rounds take longer. Fails like
/// Renderer::create.
Result<Saving> measure_saving(const scene::Scene& scene, const render::RenderOptions& options,
                              std::span<const Omission> things, double seconds);

} // namespace tidemark::lab
