// Until when a scene shows the same in float and in double.
#pragma once

#include "lab/check/probe_bench.hpp"

#include <optional>

namespace tidemark::lab {

/// A moment at which they visibly differ, 99 % of the pixels aside.
struct Mismatch {
    double seconds = 0; ///< a power of ten; the picture is a third of a second later, at a moment like most,
                        ///< which is no binary32
    FrameState state;
    image::Image floats;
    double difference = 0; ///< of the pixel that 99 % stay below
};

struct Horizon {
    double good = 0; ///< seconds: the last power of ten up to which they show the same; 0: not even 1
    std::optional<Mismatch> mismatch{};
};

/// Looks at 1, 10, … 10^6 s. Fails where the scene cannot be drawn in double, or not at all.
Result<Horizon> find_horizon(ProbeBench& bench);

} // namespace tidemark::lab
