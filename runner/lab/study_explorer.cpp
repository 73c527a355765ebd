// The diagrams of a study's page as SVG: error against time and against work.

#include "lab/report_page.hpp"
#include "lab/scatter_plot.hpp"
#include "lab/study_page.hpp"
#include "lab/work_precision.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace tidemark::lab {

/// Quantity on the horizontal axis; the error is on the vertical one.
enum class Across { time, work };

/// Returns the number of a mark's series: 0 is the unchanged scene, the study's are counted from 1.
size_t plotted_series(const WorkPrecisionSet& set, const Point& point);

/// Returns the series' mark as SVG, to be placed before a text.
std::string series_key(size_t series, bool hollow = false);

// The card of a point on a study's page: settings, error, time, work, pictures. Returns HTML.

/// Takes the index of a point that was measured.
std::string point_card(const WorkPrecisionSet& set, const PageMedia& media, size_t point);

/// Returns the picture, or a link to its file. `whose` is the name of its point; empty: it is the reference.
std::string figure_of(const PagePicture& picture, const std::string& whose);

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
                             timed ? "milliseconds per frame, median with 95 % interval" : set.words.work,
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

/// Returns the number of points in the diagram; an error of 0 has no place on a logarithmic axis.
size_t plotted_points(const WorkPrecisionSet& set, Across across) {
    return plot_of(set, across).points.size();
}

/// Returns two SVGs, for wide and narrow windows; empty if no point can be drawn.
std::string error_plot(const WorkPrecisionSet& set, Across across) {
    const report::ScatterPlot plot = plot_of(set, across);
    if (plot.points.empty())
        return {};
    return fmt::format("<div data-across=\"{}\">\n{}{}</div>\n", across == Across::time ? "time" : "work",
                       to_svg(plot, k_wide, "wide"), to_svg(plot, k_narrow, "narrow"));
}

namespace {

using report::escaped;

std::string row(const std::string& name, const std::string& value) {
    return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), value);
}

std::string settings_rows(const WorkPrecisionSet& set, const Point& point) {
    std::string rows;
    for (const std::string& name : set_names(set))
        rows += row(name, escaped(value_at(set, point, name)));
    return rows;
}

std::string result_rows(const WorkPrecisionSet& set, const Outcome& all) {
    std::string rows = row(error_name(set), error_text(set, all)) + row("ms [95 %]", time_text(all.time()));
    if (all.hits) {
        rows += row(set.words.work, number(all.hits->evaluations));
        rows += row("wrong by 0.1", number(all.hits->wrong_tenth) + " %");
    }
    if (set.has_pictures()) {
        rows += row("PSNR", number(all.picture.samples.psnr) + " dB");
        rows += row("FLIP", number(all.picture.flip));
    }
    return rows;
}

std::string figures(const std::vector<PagePicture>& pictures, const std::string& whose) {
    if (pictures.empty())
        return {};
    std::string html = "<div class=\"pictures\">\n";
    for (const PagePicture& picture : pictures)
        html += figure_of(picture, whose);
    return html + "</div>\n";
}

std::string remarks(const WorkPrecision& point) {
    std::string text = point.on_front ? "On the front: no setting here is both cheaper and more exact. " : "";
    if (point.hollow)
        text += "Hollow: its error is under ten times the reference's own. ";
    if (point.idle)
        text += "Shows the same picture as another setting. ";
    return text.empty() ? text : fmt::format("<p class=\"note\">{}</p>\n", escaped(text));
}

} // namespace

std::string figure_of(const PagePicture& picture, const std::string& whose) {
    if (picture.source.empty())
        return fmt::format("<figure><figcaption><a href=\"{}\">{}</a></figcaption></figure>\n",
                           escaped(picture.file), escaped(picture.label));
    const std::string name = escaped(whose.empty() ? picture.label : whose + ": " + picture.label);
    return fmt::format(
        "<figure><img src=\"{}\" alt=\"{}\" data-name=\"{}\"><figcaption>{}</figcaption></figure>\n",
        picture.source, name, name, escaped(picture.label));
}

std::string point_card(const WorkPrecisionSet& set, const PageMedia& media, size_t i) {
    const WorkPrecision& point = set.points[i];
    return fmt::format(
        "<article class=\"card\" id=\"point-{0}\" data-point=\"{0}\">\n<h3>{1}{2}</h3>\n<dl>\n{3}</dl>\n"
        "<dl>\n{4}</dl>\n{5}{6}<div class=\"choose\"></div>\n</article>\n",
        i, series_key(plotted_series(set, point.point), point.hollow), escaped(point.point.label),
        settings_rows(set, point.point), result_rows(set, point.all), remarks(point),
        i < media.points.size() ? figures(media.points[i], point.point.label) : "");
}

namespace {

using Json = nlohmann::ordered_json;
using report::escaped;

std::string series_title(const WorkPrecisionSet& set, size_t series) {
    if (series == 0)
        return set.words.defaults;
    const Series& own = set.study.series[series - 1];
    return own.trust == Trust::unknown ? own.name : fmt::format("{} ({})", own.name, to_string(own.trust));
}

std::string legend(const WorkPrecisionSet& set) {
    std::string items;
    for (size_t i = 0; i <= set.study.series.size(); ++i) {
        const auto has = [&](const WorkPrecision& p) {
            return p.measured() && plotted_series(set, p.point) == i;
        };
        if (std::ranges::any_of(set.points, has))
            items += fmt::format("<li data-series=\"{}\">{}{}</li>\n", i, series_key(i),
                                 escaped(series_title(set, i)));
    }
    return "<ul class=\"legend\">\n" + items + "</ul>\n";
}

std::string notes(const WorkPrecisionSet& set) {
    const size_t drawn = plotted_points(set, Across::time);
    const auto measured = size_t(std::ranges::count_if(set.points, &WorkPrecision::measured));
    std::string text = "The broad line is the front: no setting here is both cheaper and more exact. A "
                       "hollow mark has an error under ten times the reference's own.";
    if (drawn < measured)
        text += fmt::format(
            " {} of {} settings are only in the table: their error is 0 or unknown, or they were not timed.",
            measured - drawn, measured);
    return fmt::format("<p class=\"note\">{}</p>\n", escaped(text));
}

} // namespace

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media) {
    std::string html = "<div class=\"explore\">\n<div>\n" + legend(set) +
                       report::limits_form(error_name(set)) + error_plot(set, Across::time) +
                       error_plot(set, Across::work) + notes(set) +
                       "</div>\n<div class=\"cards\">\n<noscript><p class=\"note\">Click a mark in the "
                       "diagram or a setting in the table to go to its card.</p></noscript>\n";
    for (size_t i = 0; i < set.points.size(); ++i)
        if (set.points[i].measured())
            html += point_card(set, media, i);
    return html + "</div>\n</div>\n";
}

std::string comparison(const PageMedia& media) {
    if (!media.reference || media.reference->source.empty())
        return {};
    return report::comparison_form("View " + media.view + ".", figure_of(*media.reference, ""));
}

std::string explorer_data(const WorkPrecisionSet& set) {
    const auto known = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    Json points = Json::array();
    for (size_t i = 0; i < set.points.size(); ++i) {
        const WorkPrecision& point = set.points[i];
        if (!point.measured())
            continue;
        const TimeSummary& time = point.all.time();
        points.push_back({{"id", i},
                          {"label", point.point.label},
                          {"series", plotted_series(set, point.point)},
                          {"error", known(error_of(set, point.all))},
                          {"time", time.runs > 0 ? known(time.median) : Json(nullptr)}});
    }
    return Json{{"points", std::move(points)}}.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace tidemark::lab
