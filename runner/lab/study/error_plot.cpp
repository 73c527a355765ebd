#include "lab/study/error_plot.hpp"

#include "report/scatter.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tidemark::lab {
namespace {

/// For wide screens, and for narrow ones, on which letters must not shrink.
constexpr Extent k_wide{720, 440}, k_narrow{340, 400};

std::string title_of(const WorkPrecisionSet& set, const WorkPrecision& point) {
    const TimeSummary& time = point.all.time();
    return fmt::format("{}: {:.3g} ms, {} {:.3g}", point.point.label, time.median, error_name(set),
                       error_of(set, point.all));
}

report::ScatterPlot plot_of(const WorkPrecisionSet& set, Across across) {
    const bool timed = across == Across::time;
    report::ScatterPlot plot{error_name(set) + (timed ? " against time" : " against work"),
                             timed ? "milliseconds a frame, median with 95 % interval" : set.words.work,
                             error_name(set),
                             {}};
    for (size_t i = 0; i < set.points.size(); ++i) {
        const WorkPrecision& point = set.points[i];
        if (!point.measured())
            continue;
        const TimeSummary& time = point.all.time();
        const double work = point.all.hits ? point.all.hits->evaluations : 0;
        const double cost = timed ? time.median : work, error = error_of(set, point.all);
        if (!(cost > 0 && error > 0 && std::isfinite(error)))
            continue;
        const bool known = timed && time.confidence.low > 0;
        plot.points.push_back({i, plotted_series(set, point.point), cost, known ? time.confidence.low : cost,
                               known ? time.confidence.high : cost, error, point.hollow,
                               timed && point.on_front, point.point.knob, title_of(set, point)});
    }
    return plot;
}

} // namespace

size_t plotted_series(const WorkPrecisionSet& set, const Point& point) {
    return point.series < set.study.series.size() ? point.series + 1 : 0;
}

std::string series_key(size_t series, bool hollow) {
    return R"(<svg viewBox="-8 -8 16 16" aria-hidden="true">)" + report::mark_of(series, hollow) + "</svg>";
}

size_t plotted_points(const WorkPrecisionSet& set, Across across) {
    return plot_of(set, across).points.size();
}

std::string error_plot(const WorkPrecisionSet& set, Across across) {
    const report::ScatterPlot plot = plot_of(set, across);
    if (plot.points.empty())
        return {};
    return fmt::format("<div data-across=\"{}\">\n{}{}</div>\n", across == Across::time ? "time" : "work",
                       to_svg(plot, k_wide, "wide"), to_svg(plot, k_narrow, "narrow"));
}

} // namespace tidemark::lab
