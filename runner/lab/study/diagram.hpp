// Diagrams of a study as gnuplot scripts: error over time and error over work. Text out; who runs it is the
// report's affair.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// What the diagram has across; error stands upright.
enum class Across { time, work };

/// A script that, run in the report's folder, writes `NAME.svg` and `NAME.png`. Points of error 0 have no
/// place on a logarithmic axis and are left out; empty when no point is left.
std::string diagram_script(const WorkPrecisionSet& set, Across across, const std::string& name);

} // namespace tidemark::lab
