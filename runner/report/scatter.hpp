// Draws a scatter diagram on logarithmic axes as SVG: series by colour and shape, intervals, the Pareto
// front, and labels that cover nothing. Returns text; page/style.css has its colours.
#pragma once

#include "base/extent.hpp"

#include <string>
#include <vector>

namespace tidemark::report {

struct ScatterPoint {
    size_t id = 0;                       ///< number of its card, `#point-ID`
    size_t series = 0;                   ///< 0: the reference series, in the text's colour
    double x = 1, x_low = 1, x_high = 1; ///< above 0, like y
    double y = 1;
    bool hollow = false;
    bool front = false;
    std::string label{}; ///< beside the mark, if there is room
    std::string title{}; ///< tooltip and accessible name, also without scripts
};

struct ScatterPlot {
    std::string name; ///< accessible name of the diagram
    std::string x_name;
    std::string y_name;
    std::vector<ScatterPoint> points;
};

/// Returns the diagram, or an empty text without points. `form` is a CSS class by which the style picks the
/// diagram for the screen's width.
std::string to_svg(const ScatterPlot& plot, Extent size, const std::string& form);

/// Returns a series' mark around the origin as an SVG element.
std::string mark_of(size_t series, bool hollow);

} // namespace tidemark::report
