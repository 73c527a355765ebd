// Analyses the points of each curve: knobs that change nothing, and the power by which the error falls. Pure.
#pragma once

#include "lab/study/outcome.hpp"
#include "lab/study/work_precision.hpp"

#include <vector>

namespace tidemark::lab {

/// Records in `set` which knobs change nothing, and which points are idle. `sights` are the pictures and hits
/// of the points, in their order.
void find_idle(WorkPrecisionSet& set, const std::vector<Sight>& sights);

/// Records the observed order of every curve: the slope of its error over its last knob, both as logarithms,
/// by least squares over the points that are not hollow. There is none for fewer than three points, or if the
/// slopes between neighbours differ too much for one power. Call it after judge().
void observe_orders(WorkPrecisionSet& set);

/// For example "order 2.00 +- 0.02 in STEPS (the sum): …".
std::string to_string(const ObservedOrder& order);

} // namespace tidemark::lab
