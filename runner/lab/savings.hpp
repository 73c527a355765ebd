// Measures what it saves to leave something out of a scene or of a written file: with and without it,
// interleaved in one run, and whether the pixels are byte-identical. A context must be current.
#pragma once

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "render/renderer.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// How a frame is drawn and encoded.
struct Way {
    render::RenderOptions options{};
    int frames_before = 0; ///< frames drawn before the wanted one
    bool alpha = false;    ///< encode alpha even where it is 1 everywhere
};

/// One optimisation that leaves something out, and how to undo it.
struct Omission {
    std::string_view name;
    std::string_view what; ///< description of the undone optimisation, for the report
    void (*put_back)(Way&);
};

std::span<const Omission> omissions();

/// A time with and without the thing, milliseconds over all rounds.
struct Saved {
    double without = 0;  ///< median
    double more = 0;     ///< median of (with - without) of the same round
    Interval interval{}; ///< 95 % interval of `more`
};

struct SavedTime {
    Saved wall;
    Saved cpu;
};

/// Work for one frame and its file.
struct Work {
    render::FrameWork frame{};
    size_t file_bytes = 0; ///< size of the frame's PNG; 0: not measured
};

struct Saving {
    Work without{};
    Work with_it{};
    SavedTime start{}; ///< from the scene to its first frame, with the driver's cache warm
    SavedTime frame{};
    SavedTime file{}; ///< encoding the frame
    bool same_pixels = true;
    /// The reason why times, or all measurements, are missing; empty if complete.
    std::string cut{};

    bool in_frame() const { return without.frame != with_it.frame; }
    bool in_file() const { return without.file_bytes != with_it.file_bytes; }
    /// Returns whether putting the thing back changed the measured work.
    bool left_out() const { return in_frame() || in_file(); }
};

/// Measures one set of optimisations after the other against the same scene with all of them on. Driver calls
/// cannot be interrupted, so a step only starts if it should end in time, judged by the steps before.
class SavingsBench {
public:
    /// Draws the scene's first frame, without a time limit. Fails like Renderer::create.
    static Result<SavingsBench> create(const scene::Scene& scene, const render::RenderOptions& options);
    SavingsBench(SavingsBench&&) noexcept;
    ~SavingsBench();

    /// Undoes all of `things` at once and measures the difference, in at most about `seconds`.
    Result<Saving> measure(std::span<const Omission> things, double seconds);

private:
    struct Parts;
    explicit SavingsBench(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

} // namespace tidemark::lab
