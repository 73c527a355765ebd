// The tables of a study's page, as HTML.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// A row for each point, with the numbers of all views together; it leads to the point's card.
std::string points_table(const WorkPrecisionSet& set);

/// Error and time of each point on each view.
std::string views_table(const WorkPrecisionSet& set);

/// Why first hits are wrong, with heading; empty: they are not known.
std::string causes_table(const WorkPrecisionSet& set);

/// What the error is made of, with heading; empty: no source was taken away.
std::string shares_table(const WorkPrecisionSet& set);

} // namespace tidemark::lab
