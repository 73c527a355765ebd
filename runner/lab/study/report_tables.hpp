// The tables of a study's page, as HTML.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Returns a row for each point, with the numbers of all views together and a link to the point's card.
std::string points_table(const WorkPrecisionSet& set);

/// Returns the error and time of each point in each view.
std::string views_table(const WorkPrecisionSet& set);

/// Returns the causes of wrong hits, with a heading; empty if they are not known.
std::string causes_table(const WorkPrecisionSet& set);

/// Returns the shares of the error, with a heading; empty if no error source was removed.
std::string shares_table(const WorkPrecisionSet& set);

} // namespace tidemark::lab
