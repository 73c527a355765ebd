#include "lab/study/explorer.hpp"

#include "lab/study/error_plot.hpp"
#include "lab/study/point_card.hpp"
#include "report/explore.hpp"
#include "report/html.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tidemark::lab {
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
    std::string text = "The broad line is the front: nothing here is both cheaper and better. A mark without "
                       "filling is hollow: its error is under ten times the truth's own.";
    if (drawn < measured)
        text += fmt::format(
            " {} of {} settings stand in the table alone: their error is 0 or not known, or they were "
            "not timed.",
            measured - drawn, measured);
    return fmt::format("<p class=\"note\">{}</p>\n", escaped(text));
}

} // namespace

std::string explorer(const WorkPrecisionSet& set, const PageMedia& media) {
    std::string html =
        "<div class=\"explore\">\n<div>\n" + legend(set) + report::limits_form(error_name(set)) +
        error_plot(set, Across::time) + error_plot(set, Across::work) + notes(set) +
        "</div>\n<div class=\"cards\">\n<noscript><p class=\"note\">A mark of the diagram, or a setting of "
        "the table, leads to its card.</p></noscript>\n";
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
