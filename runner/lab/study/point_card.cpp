#include "lab/study/point_card.hpp"

#include "lab/study/error_plot.hpp"
#include "lab/study/report_cells.hpp"
#include "report/html.hpp"

#include <fmt/format.h>

namespace tidemark::lab {
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
    std::string text = point.on_front ? "On the front: nothing here is both cheaper and better. " : "";
    if (point.hollow)
        text += "Hollow: its error is under ten times the truth's own. ";
    if (point.idle)
        text += "Shows what another setting shows. ";
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

} // namespace tidemark::lab
