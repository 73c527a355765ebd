// Times the points of a study against each other: interleaved, in an order shuffled anew for every round.
// Each point has the same share of the budget, so that a slow one does not cost the others their rounds.
#pragma once

#include "lab/conduct.hpp"
#include "lab/specimen.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

/// Whether a point takes part in that round when it can afford `affordable` of `total`: evenly spread, and
/// the last round always, so that all points meet there.
bool takes_part(size_t round, size_t affordable, size_t total);

/// Fills the times of every measured point of `set`; false when it was stopped before all rounds were made.
bool time_points(const Timing& timing, const Watch& watch, std::vector<std::optional<Specimen>>& specimens,
                 WorkPrecisionSet& set);

} // namespace tidemark::lab
