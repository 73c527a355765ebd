#include "lab/study/report_html.hpp"

#include "lab/study/curves.hpp"
#include "lab/study/one_line.hpp"
#include "lab/study/verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace tidemark::lab {
namespace {

constexpr const char* k_style = R"(
:root { color-scheme: light dark; --line: #8884; --soft: #8882; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin-bottom: 0; } h2 { margin-top: 2.5rem; } .about { opacity: .75; }
.verdict { border-left: 4px solid #0072b2; padding: .5rem 1rem; background: var(--soft); }
.verdict p { margin: .3rem 0; } .warning { border-color: #d55e00; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px; }
.wide { overflow-x: auto; } th, td { padding: .25rem .6rem; text-align: right; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; min-width: 14rem; } td + td { white-space: nowrap; } tr.front { background: #e6e6a040; font-weight: 600; }
tr.hollow td:first-child::after { content: " \25cb"; } .failed { color: #c03030; text-align: left; white-space: pre-wrap; }
figure { margin: 1rem 0; } img { max-width: 100%; height: auto; background: #fff; }
.slider { position: relative; display: inline-block; line-height: 0; max-width: 100%; }
.slider img { display: block; width: 960px; image-rendering: pixelated; }
.slider img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 50%); }
input[type=range] { width: min(960px, 100%); display: block; } select { font: inherit; max-width: 45%; }
.chip { display: inline-block; width: .8em; height: .8em; margin-right: .3em; border: 1px solid var(--line); }
dt { font-weight: 600; } dd { margin: 0 0 .6rem 1.2rem; }
)";

constexpr const char* k_script = R"(
const left = document.getElementById('left'), right = document.getElementById('right');
const below = document.getElementById('below'), above = document.getElementById('above');
const cut = document.getElementById('cut');
const show = () => {
    below.src = pictures[left.value]; above.src = pictures[right.value];
    above.style.clipPath = 'inset(0 0 0 ' + cut.value + '%)';
};
for (const control of [left, right, cut]) control.addEventListener('input', show);
show();
)";

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : one_line(text))
        switch (c) {
        case '&': safe += "&amp;"; break;
        case '<': safe += "&lt;"; break;
        case '>': safe += "&gt;"; break;
        case '"': safe += "&quot;"; break;
        case '\'': safe += "&#39;"; break;
        default: safe += c;
        }
    return safe;
}

std::string number(double value) {
    return std::isfinite(value) ? figure(value) : std::isinf(value) ? "&infin;" : "&ndash;";
}

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
    columns.push_back(
        {"ms [95 %]", [](const WorkPrecision& p) {
             const TimeSummary& t = p.all.time();
             const std::string interval =
                 t.runs < k_fewest_runs
                     ? fmt::format("[{} rounds]", t.runs)
                     : fmt::format("[{}, {}]", number(t.confidence.low), number(t.confidence.high));
             return fmt::format("{} {}{}", number(t.median), interval, t.drifted ? " drift" : "");
         }});
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

std::string points_table(const WorkPrecisionSet& set) {
    const std::vector<Column> columns = columns_of(set);
    std::string html = "<div class=\"wide\"><table id=\"points\"><tr><th>setting</th>";
    for (const Column& column : columns)
        html += fmt::format("<th>{}</th>", column.head);
    html += "</tr>\n";
    for (const WorkPrecision& point : set.points) {
        if (!point.measured()) {
            html += fmt::format("<tr><td>{}</td><td class=\"failed\" colspan=\"{}\">{}</td></tr>\n",
                                escaped(point.point.label), columns.size(), escaped(point.failure));
            continue;
        }
        html += fmt::format("<tr class=\"{}{}\"><td>{}</td>", point.on_front ? "front " : "",
                            point.hollow ? "hollow" : "", escaped(point.point.label));
        for (const Column& column : columns)
            html += fmt::format("<td>{}</td>", column.cell(point));
        html += "</tr>\n";
    }
    return html + "</table></div>\n<p>Marked rows: the front, nothing here is both cheaper and better. "
                  "&#9675;: hollow, "
                  "the error is under ten times the reference's own.</p>\n";
}

std::string views_table(const WorkPrecisionSet& set) {
    std::string html = "<div class=\"wide\"><table><tr><th>setting</th>";
    for (const View& view : set.study.views)
        html += fmt::format("<th>{}</th>", escaped(view.name));
    html += "</tr>\n";
    for (const WorkPrecision& point : set.points) {
        if (!point.measured())
            continue;
        html += fmt::format("<tr><td>{}</td>", escaped(point.point.label));
        for (const Outcome& view : point.views)
            html +=
                fmt::format("<td>{} / {} ms</td>", number(error_of(set, view)), number(view.time().median));
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
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
        "<h2>What the error is made of</h2>\n<p>One source after another is taken away; each column is "
        "what that changed ({}), the last what then remains.</p>\n<div class=\"wide\"><table><tr>"
        "<th>setting</th>{}</tr>\n{}</table></div>\n",
        set.has_hits() ? "RMS of t / RMSE of the picture" : "RMSE of the picture", head, rows);
}

std::string causes_table(const WorkPrecisionSet& set) {
    if (!set.has_hits() || !set.has_pictures())
        return {};
    std::string html =
        "<h2>Why first hits are wrong</h2>\n<p>Pixels wrong by more than 0.1, all views together; the "
        "colours are those of the maps.</p>\n<div class=\"wide\"><table><tr><th>setting</th>";
    for (size_t i = 1; i < k_causes; ++i) {
        const auto colour = colour_of(Cause(i));
        html += fmt::format(
            "<th><span class=\"chip\" style=\"background:rgb({:.0f},{:.0f},{:.0f})\"></span>{}</th>",
            255 * colour[0], 255 * colour[1], 255 * colour[2], to_string(Cause(i)));
    }
    html += "</tr>\n";
    for (const WorkPrecision& point : set.points) {
        if (!point.measured())
            continue;
        html += fmt::format("<tr><td>{}</td>", escaped(point.point.label));
        for (size_t i = 1; i < k_causes; ++i)
            html += fmt::format("<td>{}</td>", point.all.causes[i]);
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string slider(const PageMedia& media) {
    if (media.pictures.size() < 2)
        return {};
    std::string options, sources;
    for (size_t i = 0; i < media.pictures.size(); ++i) {
        options += fmt::format("<option value=\"{}\">{}</option>", i, escaped(media.pictures[i].label));
        sources += fmt::format("{}\"{}\"", i > 0 ? ",\n" : "", media.pictures[i].source);
    }
    std::string second = options; // the scene as it is, beside the reference
    second.replace(second.find("value=\"1\""), 9, "value=\"1\" selected");
    return fmt::format(
        "<h2>Side by side</h2>\n<p>View {}. <select id=\"left\">{}</select> | <select "
        "id=\"right\">{}</select></p>\n<input id=\"cut\" type=\"range\" min=\"0\" max=\"100\" "
        "value=\"50\" aria-label=\"where the two pictures meet\">\n<div class=\"slider\"><img id=\"below\" "
        "alt=\"left\"><img id=\"above\" alt=\"right\"></div>\n<script>\nconst pictures = [{}];{}</script>\n",
        escaped(media.pictures_view), options, second, sources, k_script);
}

std::string list(const std::vector<std::string>& items) {
    std::string html = "<ul>\n";
    for (const std::string& item : items)
        html += fmt::format("<li>{}</li>\n", escaped(item));
    return html + "</ul>\n";
}

std::string standard(const char* name, const Standard& standard) {
    if (!standard.none.empty())
        return fmt::format("<dt>Reference of the {}</dt><dd>none: {}.</dd>\n", name, escaped(standard.none));
    return fmt::format("<dt>Reference of the {}</dt><dd>{}.<br>Its own error: {}; self-check: {}.{}</dd>\n",
                       name, escaped(standard.method),
                       standard.uncertainty ? figure(*standard.uncertainty) : std::string("unknown"),
                       escaped(standard.check),
                       standard.blind > 0 ? fmt::format("<br>It is NaN or infinite in {} pixels, of which no "
                                                        "error is told.",
                                                        standard.blind)
                                          : std::string());
}

std::string orders(const WorkPrecisionSet& set) {
    std::vector<std::string> items;
    for (const ObservedOrder& order : set.orders) {
        std::string fixed;
        for (const Setting& setting : order.fixed)
            fixed += fmt::format("{}{} = {}", fixed.empty() ? ", at " : ", ", setting.name, setting.value);
        items.push_back(to_string(order) + fixed);
    }
    if (items.empty())
        return {};
    return "<h2>How fast the error falls</h2>\n<p>The power of the knob by which it falls, over points that "
           "are not hollow.</p>\n" +
           list(items);
}

std::string held(const WorkPrecisionSet& set) {
    std::string items;
    for (const Setting& setting : set.held)
        items += fmt::format("{}{} = {}", items.empty() ? "" : ", ", setting.name, setting.value);
    if (items.empty())
        return {};
    return fmt::format("<dt>Held fixed</dt><dd>{}. The truth has the same, so that no figure tells what they "
                       "cost.</dd>\n",
                       escaped(items));
}

std::string method(const WorkPrecisionSet& set) {
    const Circumstances& facts = set.circumstances;
    std::string html = "<h2>How it was measured</h2>\n<dl>\n";
    if (set.has_hits())
        html += standard("hits", set.hit_standard);
    if (set.has_pictures())
        html += standard("pictures", set.picture_standard);
    html += held(set);
    html += fmt::format(
        "<dt>Time</dt><dd>{}; {} warm-up rounds, then {} rounds; in each every setting has its turn with "
        "every view "
        "once, in an order shuffled anew (fixed seed); a setting that would take more than its share of the "
        "time sits "
        "rounds out. Medians with 95 % bootstrap intervals; compiling "
        "and the first draw apart. &ldquo;All&rdquo; is the mean over the views of each round.</dd>\n",
        escaped(facts.clock), facts.warm_up_rounds, facts.timed_rounds);
    html += fmt::format("<dt>Machine</dt><dd>{}{} cores; load {:.2f} before, {:.2f} after the timing.</dd>\n",
                        facts.renderer.empty()
                            ? std::string()
                            : fmt::format("{}, OpenGL {}; ", escaped(facts.renderer), escaped(facts.driver)),
                        facts.cores, facts.load_before, facts.load_after);
    if (set.has_pictures())
        html +=
            fmt::format("<dt>Scene</dt><dd>{} (SHA-256 of its text {}), {}x{} pixels, float target{}.</dd>\n",
                        escaped(facts.scene), facts.scene_sha256.substr(0, 16), set.study.extent.width,
                        set.study.extent.height,
                        set.study.precision == glsl::Precision::single ? "" : ", drawn in double");
    html += fmt::format("<dt>Program</dt><dd>tidemark {}, started {}.</dd>\n</dl>\n", facts.tidemark,
                        facts.started);
    return html;
}

std::string figures(const std::vector<EmbeddedPicture>& diagrams) {
    std::string html;
    for (const EmbeddedPicture& diagram : diagrams)
        html += fmt::format("<figure><img src=\"{}\" alt=\"{}\"></figure>\n", diagram.source,
                            escaped(diagram.label));
    return html;
}

} // namespace

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media) {
    const std::string name = escaped(set.circumstances.scene);
    std::string html =
        fmt::format("<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                    "content=\"width=device-width\">\n<title>{} - error against run time</title>\n"
                    "<style>{}</style>\n<h1>{}</h1>\n<p class=\"about\">Error against run time. {}</p>\n",
                    name, k_style, name, escaped(set.study.about));
    html += fmt::format("<div class=\"verdict{}\">\n", set.circumstances.complete ? "" : " warning");
    for (const std::string& sentence : sentences(set))
        html += fmt::format("<p>{}</p>\n", escaped(sentence));
    html += "</div>\n<h2>Error against cost</h2>\n" + figures(media.diagrams);
    html += "<h2>Settings</h2>\n" + points_table(set);
    html += fmt::format("<h2>View by view</h2>\n<p>{} / time.</p>\n", escaped(error_name(set))) +
            views_table(set);
    html += orders(set) + slider(media) + causes_table(set) + shares_table(set) + method(set);
    std::vector<std::string> left_out = set.study.omissions;
    left_out.insert(left_out.end(), set.circumstances.remarks.begin(), set.circumstances.remarks.end());
    if (!left_out.empty())
        html += "<h2>Left out</h2>\n" + list(left_out);
    return html + "</html>\n";
}

} // namespace tidemark::lab
