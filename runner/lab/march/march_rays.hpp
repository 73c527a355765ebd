// The rays of a picture up to where they enter their marching loop: in float as the text has it, and in
// double as what proofs begin with.
#pragma once

#include "ir/texels.hpp"
#include "lab/march/input_ranges.hpp"

#include <optional>

namespace tidemark::lab {

/// Rays of an area of the picture, in pixels from the lower left corner, over a span of time.
struct RayArea {
    ir::Interval x, y;
    std::optional<ir::Interval> time{}; ///< in seconds; none: the frame's
};

/// All of them at once, in front of the loop that each of them enters.
struct AreaRays {
    size_t loop = 0;
    ir::MarchSlice slice;
};

/// A ray in front of the loop that marches along it.
struct MarchRay {
    size_t loop = 0; ///< in PassFunction::loops
    ir::March march; ///< in float
    /// Nothing where the loop carries more than the place on the ray,
    /// or is another one in double.
    std::optional<ir::MarchSlice> slice;
    /// The distance as the text has it in float, likewise.
    std::optional<ir::FloatField> in_float;
};

class MarchRays {
public:
    explicit MarchRays(DrawnPass drawn);
    MarchRays(const MarchRays&) = delete;
    MarchRays& operator=(const MarchRays&) = delete;

    Extent extent() const { return drawn_.renderer.extent(); }
    const PassFunction& function() const { return drawn_.function; }

    /// Nothing where it enters no loop. Any number of threads may ask.
    std::optional<MarchRay> enter(glm::ivec2 pixel, ir::Surface surface) const;

    /// Nothing where it is not certain that all rays enter one loop, or where that has no such slice. Any
    /// number of threads may ask.
    std::optional<AreaRays> enter_all(const RayArea& area, ir::SliceOf what, ir::Surface surface) const;

private:
    ir::Textures<ir::Interval> textures_of_all(bool at_any_time) const;

    DrawnPass drawn_;
    std::vector<std::optional<ir::LoopSlice>> steps_; ///< of each loop
    InputRanges ranges_;
    ir::TextureSet textures_;
    ir::FloatEvaluator floats_;
    ir::PointEvaluator<double> doubles_;
};

} // namespace tidemark::lab
