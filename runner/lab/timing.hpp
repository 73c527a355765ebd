// Times the points of a study against each other: interleaved, in an order shuffled anew for every round.
#pragma once

#include "lab/conduct.hpp"
#include "lab/specimen.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

/// How many rounds fit into the budget when one takes `round_seconds`: a quarter of them warm up, at least
/// one of either kind.
struct Rounds {
    size_t warm_up = 0;
    size_t timed = 0;
};
Rounds rounds_within(const Timing& timing, double round_seconds);

/// Fills the times of every measured point of `set`; false when it was stopped before all rounds were made.
bool time_points(const Timing& timing, const Watch& watch, std::vector<std::optional<Specimen>>& specimens,
                 WorkPrecisionSet& set);

} // namespace tidemark::lab
