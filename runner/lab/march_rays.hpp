// Rays of a picture's march for proofs: input ranges, rays, ranges of values, bounds of the slope.
//
// The inputs of a pass as an interval for each memory cell: the frame's own value unless it is set to a
// range.
#pragma once

#include "lab/pass_function.hpp"
#include "proof/interval.hpp"
#include "proof/texels.hpp"
#include "proof/value_ranges.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

class InputRanges {
public:
    explicit InputRanges(const DrawnPass& drawn);

    /// Sets a variable's components; no effect if the pass does not read it.
    void set(std::string_view name, std::span<const proof::Interval> ranges);
    void set(std::string_view name, const proof::Interval& range);
    /// In pixels from the lower left corner.
    void set_place(const proof::Interval& x, const proof::Interval& y);
    /// In seconds. Also sets the ranges of the uniforms that follow the time.
    void set_time(const proof::Interval& time);
    /// Sets all knobs that have a range to the whole of it.
    void turn_knobs();

    const std::vector<proof::Interval>& memory() const { return memory_; }

private:
    /// Widens all floats of the variable to every finite number.
    void set_to_anything(const proof::Variable& variable);
    const DrawnPass* drawn_;
    std::vector<proof::Interval> memory_;
};

/// Returns the range of a sampler whose values change over time; nullopt if it keeps those of the last frame.
std::optional<proof::Interval> changing(const DrawnPass& drawn, const std::string& sampler);

// Sets up a picture's rays at the entry of their marching loop: in float, as in the text, and in double, from
// which proofs start.

/// The rays of an area of the picture, in pixels from the lower left corner, over a time span.
struct RayArea {
    proof::Interval x, y;
    std::optional<proof::Interval> time{}; ///< in seconds; nullopt: the frame's time
};

/// All rays of an area at once, at the entry of the loop that each of them enters.
struct AreaRays {
    size_t loop = 0;
    proof::MarchSlice slice;
};

/// A ray at the entry of its marching loop.
struct MarchRay {
    size_t loop = 0;    ///< index in PassFunction::loops
    proof::March march; ///< in float
    /// Not set if the loop carries more than the place on the ray, or if the ray enters another loop in
    /// double.
    std::optional<proof::MarchSlice> slice;
    /// The distance in float, as in the text; not set under the same conditions.
    std::optional<proof::FloatField> in_float;
};

/// A pixel whose march may take more iterations than its counters allow.
struct LongerMarch {
    bool hits = false;  ///< the march ends in a hit then
    bool shows = false; ///< a colour changes by more than 1/255, or is not known
};

class MarchRays {
public:
    explicit MarchRays(DrawnPass drawn);
    MarchRays(const MarchRays&) = delete;
    MarchRays& operator=(const MarchRays&) = delete;

    Extent extent() const { return drawn_.renderer.extent(); }
    const PassFunction& function() const { return drawn_.function; }

    /// Returns nullopt if the ray enters no loop. Thread-safe.
    std::optional<MarchRay> enter(glm::ivec2 pixel, proof::Surface surface) const;

    /// Runs a pixel with up to `most` iterations of the marching loop that it enters, whatever the loop's
    /// counters say. Thread-safe.
    LongerMarch march_longer(glm::ivec2 pixel, uint32_t most) const;

    /// Returns nullopt if the rays may enter different loops, or if their loop has no slice of that kind.
    /// Thread-safe.
    std::optional<AreaRays> enter_all(const RayArea& area, proof::SliceOf what, proof::Surface surface) const;

private:
    proof::Textures<proof::Interval> textures_of_all(bool at_any_time) const;
    std::vector<float> outputs(const proof::FloatEvaluator& evaluator) const;

    DrawnPass drawn_;
    std::vector<std::optional<proof::LoopSlice>> steps_; ///< by loop
    InputRanges ranges_;
    proof::TextureSet textures_;
    proof::FloatEvaluator floats_;
    proof::PointEvaluator<double> doubles_;
};

// Bounds the values of a pass over all pixels of a frame and a time span at once.

/// The time runs from 0 to `seconds`; each knob takes its whole range; the mouse is that of the drawn frame.
/// Other passes' pictures may be any finite number; keys, sound and videos are from 0 to 1.
proof::ValueRanges ranges_of(const DrawnPass& drawn, double seconds);

// Bounds how fast the field of a march falls along its rays, over the whole picture, including between the
// rays.

/// Bounds for the space before the surface that a picture's rays cross, divided into pieces of some pixels
/// each and some length along them. Lengths are those of the picture's rays through the pieces.
struct AreaSlopes {
    struct Bound {
        double falls; ///< most the field falls per unit of length, outside of jumps
        double way;
    };
    std::vector<Bound> bounded{};
    double may_jump = 0;   ///< the part of the bounded length in which it may jump
    double unbounded = 0;  ///< length in which no bound of the slope is known
    double not_finite = 0; ///< length in which it may be NaN or infinite

    double bounded_way() const;
    double way() const { return bounded_way() + unbounded + not_finite; }
    /// Returns the least bound of the slope that holds for the share `part` of the bounded length.
    double falls_on(double part) const;

    void add(const AreaSlopes& more);
};

/// Computes the bounds for the frame's time, up to the hits of rays in the middle of each piece, or to the
/// loop's limit. They are empty if no ray enters a march.
AreaSlopes area_slopes(const MarchRays& rays, uint64_t most_evaluations);

} // namespace tidemark::lab
