#include "lab/study/report_tables.hpp"

#include "lab/study/report_cells.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace tidemark::lab {
namespace {

using report::escaped;

/// A column of the table of points.
struct Column {
    const char* head;
    std::function<std::string(const WorkPrecision&)> cell;
};

void add_picture_columns(std::vector<Column>& columns) {
    columns.push_back({"PSNR dB", [](const WorkPrecision& p) { return number(p.all.picture.samples.psnr); }});
    columns.push_back({"SSIM", [](const WorkPrecision& p) {
                           const double ssim = p.all.picture.ssim;
                           return std::isfinite(ssim) ? fmt::format("{:.5f}", ssim) : number(ssim);
                       }});
    columns.push_back({"FLIP", [](const WorkPrecision& p) { return number(p.all.picture.flip); }});
    columns.push_back({"not finite", [](const WorkPrecision& p) {
                           const auto& s = p.all.picture.samples;
                           return fmt::format("{}", s.one_non_finite + s.both_non_finite);
                       }});
}

void add_compiling_columns(std::vector<Column>& columns) {
    columns.push_back({"compile ms", [](const WorkPrecision& p) { return number(p.compile_milliseconds); }});
    columns.push_back(
        {"first draw ms", [](const WorkPrecision& p) { return number(p.first_draw_milliseconds); }});
}

std::vector<Column> columns_of(const WorkPrecisionSet& set) {
    std::vector<Column> columns;
    // If hits rank the points, their RMS is a column below.
    if (!set.ranked_by_hits())
        columns.push_back({"RMSE", [&set](const WorkPrecision& p) { return number(error_of(set, p.all)); }});
    columns.push_back({"ms [95 %]", [](const WorkPrecision& p) { return time_text(p.all.time()); }});
    if (set.has_hits()) {
        const auto hit = [&](const char* head, double HitErrors::*field) {
            columns.push_back({head, [field](const WorkPrecision& p) {
                                   return p.all.hits ? number((*p.all.hits).*field) : std::string();
                               }});
        };
        hit("RMS t", &HitErrors::rms);
        hit("RMS t of right hits", &HitErrors::rms_right);
        hit("p99 t", &HitErrors::p99);
        hit("largest t", &HitErrors::largest);
        hit("false miss %", &HitErrors::false_miss);
        hit("false hit %", &HitErrors::false_hit);
        hit("wrong by 0.1 %", &HitErrors::wrong_tenth);
        hit("wrong by a pixel %", &HitErrors::wrong_footprint);
        hit("evaluations", &HitErrors::evaluations);
    }
    if (set.has_pictures())
        add_picture_columns(columns);
    columns.push_back({"least ms", [](const WorkPrecision& p) { return number(p.all.time().smallest); }});
    columns.push_back({"CPU ms", [](const WorkPrecision& p) { return number(p.all.cpu.median); }});
    if (set.has_pictures())
        add_compiling_columns(columns);
    return columns;
}

/// Returns the first cell of a row, with a link to the point's card.
std::string setting_cell(const WorkPrecisionSet& set, size_t point) {
    return fmt::format(R"(<td><a href="#point-{0}" data-point="{0}">{1}</a></td>)", point,
                       escaped(set.points[point].point.label));
}

std::string point_row(const WorkPrecisionSet& set, const std::vector<Column>& columns, size_t i) {
    const WorkPrecision& point = set.points[i];
    if (!point.measured())
        return fmt::format("<tr><td>{}</td><td class=\"failed\" colspan=\"{}\">{}</td></tr>\n",
                           escaped(point.point.label), columns.size(), escaped(point.failure));
    std::string html = fmt::format(R"(<tr class="{}{}" data-point="{}">{})", point.on_front ? "front " : "",
                                   point.hollow ? "hollow" : "", i, setting_cell(set, i));
    for (const Column& column : columns)
        html += fmt::format("<td>{}</td>", column.cell(point));
    return html + "</tr>\n";
}

} // namespace

std::string points_table(const WorkPrecisionSet& set) {
    const std::vector<Column> columns = columns_of(set);
    std::string rows = "<tr><th>setting</th>";
    for (const Column& column : columns)
        rows += fmt::format("<th>{}</th>", column.head);
    rows += "</tr>\n";
    for (size_t i = 0; i < set.points.size(); ++i)
        rows += point_row(set, columns, i);
    return report::table("Settings and their numbers", rows) +
           "<p class=\"note\">Marked rows: the front, nothing here is both cheaper and better. &#9675;: "
           "hollow, "
           "the error is under ten times the truth's own.</p>\n";
}

std::string views_table(const WorkPrecisionSet& set) {
    std::string rows = "<tr><th>setting</th>";
    for (const View& view : set.study.views)
        rows += fmt::format("<th colspan=\"2\">{}</th>", escaped(view.name));
    rows += "</tr>\n";
    for (size_t i = 0; i < set.points.size(); ++i) {
        if (!set.points[i].measured())
            continue;
        rows += fmt::format("<tr data-point=\"{}\">{}", i, setting_cell(set, i));
        for (const Outcome& view : set.points[i].views)
            rows += fmt::format("<td>{}</td><td>{} ms</td>", number(error_of(set, view)),
                                number(view.time().median));
        rows += "</tr>\n";
    }
    return fmt::format("<h2>View by view</h2>\n<p class=\"note\">{}, and time.</p>\n",
                       escaped(error_name(set))) +
           report::table("Error and time on each view", rows);
}

std::string shares_table(const WorkPrecisionSet& set) {
    std::string head, rows;
    for (const WorkPrecision& point : set.points) {
        if (point.shares.empty())
            continue;
        if (head.empty())
            for (const Share& share : point.shares)
                head += fmt::format("<th>{}</th>", escaped(share.source));
        rows += fmt::format("<tr><td>{}</td>", escaped(point.point.label));
        for (const Share& share : point.shares)
            rows += set.has_hits() ? fmt::format("<td>{} / {}</td>", number(share.rms), number(share.rmse))
                                   : fmt::format("<td>{}</td>", number(share.rmse));
        rows += "</tr>\n";
    }
    if (rows.empty())
        return {};
    return fmt::format(
        "<h2>What the error is made of</h2>\n<p class=\"note\">One source after another is taken away; "
        "each column is what that changed ({}), the last what then remains.</p>\n{}",
        set.has_hits() ? "RMS of t / RMSE of the picture" : "RMSE of the picture",
        report::table("Sources of error", "<tr><th>setting</th>" + head + "</tr>\n" + rows));
}

std::string causes_table(const WorkPrecisionSet& set) {
    if (!set.has_hits() || !set.has_pictures())
        return {};
    std::string rows = "<tr><th>setting</th>";
    for (size_t i = 1; i < k_causes; ++i) {
        const auto colour = colour_of(Cause(i));
        rows += fmt::format(
            "<th><span class=\"chip\" style=\"background:rgb({:.0f},{:.0f},{:.0f})\"></span>{}</th>",
            255 * colour[0], 255 * colour[1], 255 * colour[2], to_string(Cause(i)));
    }
    rows += "</tr>\n";
    for (const WorkPrecision& point : set.points) {
        if (!point.measured())
            continue;
        rows += fmt::format("<tr><td>{}</td>", escaped(point.point.label));
        for (size_t i = 1; i < k_causes; ++i)
            rows += fmt::format("<td>{}</td>", point.all.causes[i]);
        rows += "</tr>\n";
    }
    return "<h2>Why first hits are wrong</h2>\n<p class=\"note\">Pixels wrong by more than 0.1, all views "
           "together; the "
           "colours are those of the maps.</p>\n" +
           report::table("Causes of wrong hits", rows);
}

} // namespace tidemark::lab
