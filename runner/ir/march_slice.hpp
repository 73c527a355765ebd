// The distance that a marching loop tests, as a function of the ray's parameter alone: all else is what it
// was when a pixel entered the loop. Evaluated over intervals, it bounds the field on a piece of the ray.
#pragma once

#include "ir/interval_system.hpp"
#include "ir/loop_turn.hpp"
#include "ir/tangent_system.hpp"

#include <optional>
#include <vector>

namespace tidemark::ir {

/// One turn of the loop as the text makes it, in float.
struct Turn {
    std::vector<float> carried; ///< the values of MarchingLoop::carried where the distance is measured
    float measured = 0;         ///< distance
    float threshold = 0;

    float distance() const { return measured - threshold; } ///< above the threshold
};

/// The march of one pixel.
struct March {
    std::vector<Turn> turns;
    std::optional<float> far{}; ///< the loop's limit, where it has a finite one
    bool hit = false;           ///< it was left because of the distance
};

/// What becomes of conditions and jumps that are not decided: they cost width; or they are gone through one
/// by one, as far as that is few ways, or many.
enum class Care { quick, close, thorough };

/// What counts as hit: where the loop's own test holds, or where the distance itself is below 0.
enum class Surface { threshold, zero };

/// A place on a ray that is not one number: those are floats, and what floats make of them is rounded.
inline Interval place_at(double parameter) {
    return std::isfinite(parameter) ? Interval{parameter, std::nextafter(parameter, k_infinity)}
                                    : everything();
}

/// Everything but the ray's parameter is as `entered` has it, which has run up to the loop's entry: of one
/// ray, or of all rays of an area and a span of time at once, if it has intervals.
class MarchSlice {
public:
    template <class System>
    MarchSlice(const LoopSlice& slice, const Evaluator<System>& entered,
               const Textures<Interval>& textures = {}, Surface surface = Surface::threshold);

    /// Where the ray begins, in terms of its parameter; the first of the rays. -infinity, where it may begin
    /// at NaN or at an infinity.
    double start() const { return start_; }
    /// The parameter at which a turn measured.
    double parameter(const Turn& turn) const;
    /// How long the way is that the parameter calls 1: 1, where the loop carries the parameter itself. Of
    /// many rays at least.
    double unit() const;
    /// Up to where a first hit is looked for: the loop's limit; else the last place that the march came to,
    /// and beyond its own hit. What has no limit may go to infinity.
    double end(const March& march) const;
    /// The loop's limit, where all rays have a finite one: the largest.
    std::optional<double> far() const { return far_; }

    /// Bounds, over that piece of the ray, of what is negative behind the surface; `partial` where NaN or an
    /// infinity may come of it. Nothing where the loop is left before it measures.
    std::optional<Interval> distance(const Interval& parameter, Care care);
    /// That, and the distance above the loop's threshold, whatever the surface is.
    struct Distances {
        Interval own;
        Interval above_threshold;
    };
    std::optional<Distances> distances(const Interval& parameter, Care care);
    /// The same with bounds of its slope, where all conditions are decided and nothing jumps: nothing else.
    std::optional<Tangent> tangent(const Interval& parameter);
    /// Bounds of its slope beside jumps, whatever conditions are; nothing where those are not known.
    std::optional<Interval> slope_beside_jumps(const Interval& parameter);

    /// Of a slice that has the step: what a turn adds to the parameter where it goes on from a place of the
    /// piece; nothing where the loop is left at all of them.
    std::optional<Interval> advance(const Interval& parameter, Care care);

    /// Of what `distance` gives: no place of the piece is a hit; every one is.
    bool excludes_hit(const std::optional<Interval>& distance) const;
    bool is_hit(const std::optional<Interval>& distance) const;
    /// Runs of the loop's turn so far; a very long one counts as several.
    uint64_t evaluations() const { return evaluations_; }

private:
    /// What a turn compares.
    template <class Number>
    struct Compared {
        Number distance, threshold;
    };
    template <class System>
    std::optional<Compared<typename System::Value>>
    run(LoopTurn<System>& turn, const std::vector<typename System::Value>& places, Decisions& decisions);
    Interval place(size_t carried, const Interval& parameter) const;
    std::vector<Interval> places(const Interval& parameter) const;
    std::vector<Tangent> moving_places(const Interval& parameter) const;
    Tangent own(const Compared<Tangent>& found) const;
    void set(Care care) { intervals_.evaluator().splits = care != Care::quick; }

    const MarchingLoop* loop_;
    Surface surface_;
    LoopTurn<IntervalSystem> intervals_;
    LoopTurn<TangentSystem> tangents_;
    std::vector<Interval> first_, factor_;
    double start_ = 0;
    std::optional<double> far_;
    uint64_t evaluations_ = 0;
};

/// The distance itself, in float: what the text has where its march comes to that place.
class FloatField {
public:
    FloatField(const LoopSlice& slice, const FloatEvaluator& entered);

    /// Of a ray's parameter, as MarchSlice has it. Nothing where the loop is left before it measures.
    std::optional<float> distance(double parameter);

private:
    LoopTurn<PointSystem<float>> turn_;
    bool by_parameter_;
    std::vector<float> first_, factor_;
};

/// Runs the pixel that `evaluator` is set up for until it enters one of the loops; its index, none where it
/// enters none, or where it is not known which.
template <class System>
std::optional<size_t> enter_first(Evaluator<System>& evaluator, const std::vector<MarchingLoop>& loops) {
    Decisions none(0);
    std::optional<size_t> entered;
    const auto visit = [&](uint32_t block) {
        for (size_t i = 0; i < loops.size(); ++i)
            if (block == loops[i].header)
                entered = i;
        return !entered;
    };
    evaluator.run(none, visit);
    return entered;
}

/// Goes on from there through the loop.
March follow(FloatEvaluator& evaluator, const Function& function, const MarchingLoop& loop);

/// Whether the slice at the text's own places has the text's own distances and thresholds, bit by bit: else
/// something that the loop carries beside the place changes them. A threshold that changes by turns may be
/// above that of the first.
bool is_faithful(const LoopSlice& slice, const FloatEvaluator& entered, const March& march);

} // namespace tidemark::ir
