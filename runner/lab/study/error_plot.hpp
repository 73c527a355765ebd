// The diagrams of a study's page as SVG: error against time and against work.
#pragma once

#include "lab/study/diagram.hpp"
#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Returns the number of a mark's series: 0 is the unchanged scene, the study's are counted from 1.
size_t plotted_series(const WorkPrecisionSet& set, const Point& point);

/// Returns the series' mark as SVG, to be placed before a text.
std::string series_key(size_t series, bool hollow = false);

/// Returns the number of points in the diagram; an error of 0 has no place on a logarithmic axis.
size_t plotted_points(const WorkPrecisionSet& set, Across across);

/// Returns two SVGs, for wide and narrow windows; empty if no point can be drawn.
std::string error_plot(const WorkPrecisionSet& set, Across across);

} // namespace tidemark::lab
