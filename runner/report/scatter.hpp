// A scatter diagram on logarithmic axes as SVG: series told apart by colour and shape, intervals, the front,
// labels that cover nothing. Text out; its colours are those of page/style.css.
#pragma once

#include "base/extent.hpp"

#include <string>
#include <vector>

namespace tidemark::report {

struct ScatterPoint {
    size_t id = 0;                       ///< of its card, `#point-ID`
    size_t series = 0;                   ///< 0: what the others are held against, in the colour of ink
    double x = 1, x_low = 1, x_high = 1; ///< above 0, as y is
    double y = 1;
    bool hollow = false;
    bool front = false;
    std::string label{}; ///< beside the mark, where there is room
    std::string title{}; ///< what a pointer at rest is told, scripts or not
};

struct ScatterPlot {
    std::string name; ///< of the whole, for who does not see it
    std::string x_name;
    std::string y_name;
    std::vector<ScatterPoint> points;
};

/// Nothing without points. `form`: the class by which the style chooses the form that fits the screen.
std::string to_svg(const ScatterPlot& plot, Extent size, const std::string& form);

/// The mark of a series around the origin, an element of SVG.
std::string mark_of(size_t series, bool hollow);

} // namespace tidemark::report
