// A study as data for other programs: JSON with everything, CSV with a row for each point and view. Returns
// text.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

inline constexpr const char* k_study_schema = "tidemark study 1";

/// The format is described in runner/lab/study/README.md, "Results". NaN and infinity are null.
std::string to_json(const WorkPrecisionSet& set);

/// Returns one row for each point and view, and one for all views together.
std::string to_csv(const WorkPrecisionSet& set);

} // namespace tidemark::lab
