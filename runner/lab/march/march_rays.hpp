// Sets up a picture's rays at the entry of their marching loop: in float, as in the text, and in double, from
// which proofs start.
#pragma once

#include "ir/texels.hpp"
#include "lab/march/input_ranges.hpp"

#include <optional>

namespace tidemark::lab {

/// The rays of an area of the picture, in pixels from the lower left corner, over a time span.
struct RayArea {
    ir::Interval x, y;
    std::optional<ir::Interval> time{}; ///< in seconds; nullopt: the frame's time
};

/// All rays of an area at once, at the entry of the loop that each of them enters.
struct AreaRays {
    size_t loop = 0;
    ir::MarchSlice slice;
};

/// A ray at the entry of its marching loop.
struct MarchRay {
    size_t loop = 0; ///< index in PassFunction::loops
    ir::March march; ///< in float
    /// Not set if the loop carries more than the place on the ray, or if the ray enters another loop in
    /// double.
    std::optional<ir::MarchSlice> slice;
    /// The distance in float, as in the text; not set under the same conditions.
    std::optional<ir::FloatField> in_float;
};

class MarchRays {
public:
    explicit MarchRays(DrawnPass drawn);
    MarchRays(const MarchRays&) = delete;
    MarchRays& operator=(const MarchRays&) = delete;

    Extent extent() const { return drawn_.renderer.extent(); }
    const PassFunction& function() const { return drawn_.function; }

    /// Returns nullopt if the ray enters no loop. Thread-safe.
    std::optional<MarchRay> enter(glm::ivec2 pixel, ir::Surface surface) const;

    /// Returns nullopt if the rays may enter different loops, or if their loop has no slice of that kind.
    /// Thread-safe.
    std::optional<AreaRays> enter_all(const RayArea& area, ir::SliceOf what, ir::Surface surface) const;

private:
    ir::Textures<ir::Interval> textures_of_all(bool at_any_time) const;

    DrawnPass drawn_;
    std::vector<std::optional<ir::LoopSlice>> steps_; ///< by loop
    InputRanges ranges_;
    ir::TextureSet textures_;
    ir::FloatEvaluator floats_;
    ir::PointEvaluator<double> doubles_;
};

} // namespace tidemark::lab
