// Numbers of a study as a page writes them, with units and intervals. HTML out.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Three digits, zeros too, so that columns align; a dash for what is not known.
std::string number(double value);

/// `0.612 [0.408, 0.705]`, in milliseconds.
std::string time_text(const TimeSummary& time);

/// `0.0123 ± 0.0001`: with the truth's own error, where that is known.
std::string error_text(const WorkPrecisionSet& set, const Outcome& outcome);

} // namespace tidemark::lab
