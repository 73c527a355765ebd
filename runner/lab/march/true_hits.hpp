// Where the rays of a picture first meet the surface, proved from the scene's own text: the first zero of the
// distance that its march measures, in real arithmetic, on rays set up in double.
#pragma once

#include "ir/texels.hpp"
#include "lab/hits.hpp"
#include "lab/march/pass_function.hpp"
#include "lab/watch.hpp"

#include <cstddef>
#include <optional>

namespace tidemark::lab {

struct TrueHits {
    Hits hits; ///< NaN: not looked at, or not known; -1: nothing up to the march's limit
    size_t looked_at = 0;
    size_t unknown = 0;    ///< of those
    double half_width = 0; ///< of the proved places, root of the mean square
};

/// A pass as its text and a frame have it.
struct DrawnPass {
    const PassFunction& function;
    const render::Renderer& renderer; ///< has drawn the frame
    size_t pass = 0;
    render::FrameInputs inputs;
};

/// Of as many pixels, evenly spread, as `seconds` of each core allow. Nothing where `keep_going` ends it.
std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going);

} // namespace tidemark::lab
