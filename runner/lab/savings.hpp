// What leaving a thing out of a scene, or of the file that a frame goes into, saves: without it and with it,
// interleaved in one run, and whether the pixels are the same bytes. A context must be current.
#pragma once

#include "base/result.hpp"
#include "lab/statistics.hpp"
#include "render/renderer.hpp"

#include <memory>
#include <span>
#include <string>
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
    /// Why times are missing, or all of it; empty: nothing is.
    std::string cut{};

    bool in_frame() const { return without.frame != with_it.frame; }
    bool in_file() const { return without.file_bytes != with_it.file_bytes; }
    /// Putting it back made a difference to measure.
    bool left_out() const { return in_frame() || in_file(); }
};

/// Measures one thing after the other against the same scene without any. What the driver does cannot be
/// interrupted: what is begun is what, by the steps before, will be done in time.
class SavingsBench {
public:
    /// Draws the scene's first frame, in whatever time that takes. Fails like Renderer::create.
    static Result<SavingsBench> create(const scene::Scene& scene, const render::RenderOptions& options);
    SavingsBench(SavingsBench&&) noexcept;
    ~SavingsBench();

    /// Puts all of `things` back at once. Takes at most about some `seconds`.
    Result<Saving> measure(std::span<const Omission> things, double seconds);

private:
    struct Parts;
    explicit SavingsBench(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

} // namespace tidemark::lab
