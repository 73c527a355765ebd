// Formats a study's numbers for the page, with units and intervals. Returns HTML.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Three digits, including trailing zeros, so that columns align; a dash if the value is not known.
std::string number(double value);

/// For example `0.612 [0.408, 0.705]`, in milliseconds.
std::string time_text(const TimeSummary& time);

/// For example `0.0123 ± 0.0001`: includes the truth's own error if it is known.
std::string error_text(const WorkPrecisionSet& set, const Outcome& outcome);

} // namespace tidemark::lab
