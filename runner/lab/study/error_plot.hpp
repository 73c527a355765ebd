// The diagrams of a study's page: error against time and against work, as SVG.
#pragma once

#include "lab/study/diagram.hpp"
#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Of a mark: 0 is the scene as it is, the others are those of the study, from 1.
size_t plotted_series(const WorkPrecisionSet& set, const Point& point);

/// Its mark, to stand before a word.
std::string series_key(size_t series, bool hollow = false);

/// How many points have a place there: an error of 0 has none on a logarithmic axis.
size_t plotted_points(const WorkPrecisionSet& set, Across across);

/// Once for wide windows and once for narrow ones; empty: no point has a place.
std::string error_plot(const WorkPrecisionSet& set, Across across);

} // namespace tidemark::lab
