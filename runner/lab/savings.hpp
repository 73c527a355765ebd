// What leaving a thing out of a scene, or of the file that a frame goes into, saves: without it and with it,
// interleaved in one run, and whether the pixels are the same bytes. A context must be current.
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
    bool alpha = false;    ///< goes into the file even where it is 1 all over
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

/// What a frame takes on its way into a file.
struct Work {
    render::FrameWork frame{};
    size_t file_bytes = 0; ///< of a PNG of it; 0: its file is not in question
};

struct Saving {
    Work without{};
    Work with_it{};
    SavedTime start{}; ///< from the scene to its first frame, the driver's cache warm
    SavedTime frame{};
    SavedTime file{}; ///< encoding it
    bool same_pixels = true;

    bool in_frame() const { return without.frame != with_it.frame; }
    bool in_file() const { return without.file_bytes != with_it.file_bytes; }
    /// Putting it back made a difference to measure.
    bool left_out() const { return in_frame() || in_file(); }
};

/// Puts all of `things` back at once. Takes some `seconds`, more where five rounds take longer. Fails like
/// Renderer::create.
Result<Saving> measure_saving(const scene::Scene& scene, const render::RenderOptions& options,
                              std::span<const Omission> things, double seconds);

} // namespace tidemark::lab
