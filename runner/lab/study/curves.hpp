// What the points of a curve say together: knobs that change nothing, and the power by which the error falls.
// Pure.
#pragma once

#include "lab/study/outcome.hpp"
#include "lab/study/work_precision.hpp"

#include <vector>

namespace tidemark::lab {

/// Notes in `set` which knobs change nothing, and which points are idle. `sights` are what the points show,
/// in their order.
void find_idle(WorkPrecisionSet& set, const std::vector<Sight>& sights);

/// Notes the observed order of every curve: the slope of its error over its last knob, both as logarithms, by
/// least squares over the points that are not hollow. None of fewer than three, and none where the slopes
/// between neighbours are too different for one power. After judge().
void observe_orders(WorkPrecisionSet& set);

/// "order 2.00 +- 0.02 in STEPS (the sum): …".
std::string to_string(const ObservedOrder& order);

} // namespace tidemark::lab
