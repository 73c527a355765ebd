// What a search through a scene's moments, knobs and mouse has seen (lab/check/exploration.hpp).
#pragma once

#include "lab/check/probe_state.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// Which pixels of a pass are drawn: every `stride`-th from one on.
struct PixelGrid {
    int stride = 1;
    int left = 0;
    int down = 0;
};

/// A finer grid of as many pixels, within a picture of `whole`; its middle is where `grid` has its pixel
/// number `pixel`, of `part` pixels row by row from the bottom.
PixelGrid finer(const PixelGrid& grid, Extent part, uint32_t pixel, Extent whole);

/// A value that left its domain, where it first did.
struct Outside {
    FrameState where;
    PixelGrid grid;       ///< of the pixels that showed it
    bool bound = false;   ///< of an index, a shift, a divisor, a texel or a conversion
    std::string sentence; ///< of a bound: place, operand, pixel and moment
};

struct Explored {
    /// In which a pass was not finite, the first one first; drawn once more as it is, and still so.
    std::vector<FrameState> not_finite;
    std::vector<Outside> outside; ///< one for each site
    /// "sampled: 240 situations, …": what was looked at, and how.
    std::string sentence;
    std::string left_out; ///< why the text was not followed; empty: it was
};

} // namespace tidemark::lab
