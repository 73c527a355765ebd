// The interactive part of a study's page, and its diagrams as SVG.
#pragma once

#include "base/extent.hpp"
#include "lab/study_report.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::report {

// A logarithmic axis of a diagram: maps values to pixels and chooses the tick values.

struct LogAxis {
    double low = 1;   ///< above 0
    double high = 10; ///< above low
    double first = 0; ///< the pixel of `low`
    double last = 1;  ///< the pixel of `high`; may lie before `first`

    double pixel(double value) const;
};

/// Returns an axis for values from `least` to `most`, both above 0, with a margin of 7 % at either end.
LogAxis log_axis(double least, double most, double first, double last);

/// Returns the ticks within the axis in increasing order: powers of ten if there are at least three, else 1,
/// 2 and 5 times these, else round numbers. At most ten.
std::vector<double> ticks(const LogAxis& axis);

/// Formats a tick: `0.05`, `200`, `10⁻⁵`, `2·10⁻⁵`.
std::string tick_text(double value);

// Places labels beside marks so that none covers another label, a mark, or the edge. Greedy, in the given
// order; pure.

/// A rectangle in pixels, y downwards.
struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;

    bool overlaps(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    bool holds(const Box& other) const {
        return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
    }
};

struct Label {
    double x = 0, y = 0; ///< position of its mark
    double width = 0;    ///< width of its text
};

inline constexpr double k_label_height = 14;

/// Returns a place beside each mark, within `bounds`, on the right if possible; nothing if every place covers
/// an obstacle or an earlier label.
std::vector<std::optional<Box>> place_labels(std::span<const Label> labels, std::span<const Box> obstacles,
                                             const Box& bounds);

// Draws a scatter diagram on logarithmic axes as SVG: series by colour and shape, intervals, the Pareto
// front, and labels that cover nothing. Returns text; page/style.css has its colours.

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

namespace tidemark::lab {

// The interactive part of a study's page: diagrams with their legend and limits, a card for each point, two
// pictures side by side. Returns HTML; the scripts are in page/.

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media);

/// Returns the section that compares two pictures; empty if there are none.
std::string comparison(const PageMedia& media);

/// Returns the data for the scripts, as JSON.
std::string explorer_data(const WorkPrecisionSet& set);

} // namespace tidemark::lab
