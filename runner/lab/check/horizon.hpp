// Finds the time up to which a scene looks the same in float and in double.
#pragma once

#include "lab/check/probe_bench.hpp"

#include <optional>

namespace tidemark::lab {

/// A moment at which more than 1 % of the pixels differ visibly between float and double.
struct Mismatch {
    /// A power of ten. The picture is a third of a second later: a typical moment, which binary32 cannot
    /// represent.
    double seconds = 0;
    FrameState state;
    image::Image floats;
    double difference = 0; ///< 99th percentile over the pixels
};

struct Horizon {
    double good = 0; ///< seconds: the last power of ten up to which both look the same; 0: they differ at 1 s
    std::optional<Mismatch> mismatch{};
};

/// Compares at 1, 10, … 10^6 s (each plus a third). Fails if the scene cannot be drawn, or not in double.
Result<Horizon> find_horizon(ProbeBench& bench);

} // namespace tidemark::lab
