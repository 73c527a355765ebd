// A frame of a capture: its pixels, and what became of it.
#pragma once

#include "image/image.hpp"

#include <string>

namespace tidemark::cli {

/// What became of one frame, for `--json`. What it showed is asked of its number anew: of 10,000 frames their
/// states would be 30 MB.
struct FrameRecord {
    int frame = 0;
    std::string file;
    std::string sha256;
    double milliseconds = 0;
    size_t not_finite = 0;   ///< pixels
    size_t no_coverage = 0;  ///< pixels of an alpha that is kept and below 0 or above 1
    size_t passes_drawn = 0; ///< on the way to it too; 0: it is the frame before
};

struct DrawnFrame {
    FrameRecord record;
    image::Image picture;
};

} // namespace tidemark::cli
