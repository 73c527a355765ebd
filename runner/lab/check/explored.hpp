// Results of the search through a scene's moments, knobs and mouse positions (lab/check/exploration.hpp).
#pragma once

#include "lab/check/probe_state.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// The pixels of a pass to draw: every `stride`-th, starting at (left, down).
struct PixelGrid {
    int stride = 1;
    int left = 0;
    int down = 0;
};

/// Returns a grid with as many pixels but a smaller stride, inside a picture of size `whole`. Its middle is
/// the place of pixel number `pixel` of `grid`, counted row by row from the bottom; `part` is the size of the
/// grids in pixels.
PixelGrid finer(const PixelGrid& grid, Extent part, uint32_t pixel, Extent whole);

/// A site at which a value left its domain, with the first situation that showed it.
struct Outside {
    FrameState where;
    PixelGrid grid;       ///< of the pixels that showed it
    bool bound = false;   ///< index, shift, whole-number divisor, texel or conversion
    std::string sentence; ///< only if `bound`: place, operand, pixel and moment
};

struct Explored {
    /// Situations in which a pass is not finite, confirmed by drawing the scene's own text; the first one
    /// found comes first.
    std::vector<FrameState> not_finite;
    std::vector<Outside> outside; ///< one per site
    /// "sampled: 240 situations, …": what was sampled, and how.
    std::string sentence;
    std::string left_out; ///< why the text was not instrumented; empty: it was
};

} // namespace tidemark::lab
