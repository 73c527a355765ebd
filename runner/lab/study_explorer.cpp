#include "lab/study_explorer.hpp"

#include "base/encoding.hpp"
#include "lab/report_page.hpp"
#include "lab/work_precision.hpp"
#include "scene/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::report {
namespace {

/// Margin beyond the outermost values, as a fraction of the axis.
constexpr double k_room = 0.07;
constexpr size_t k_fewest_ticks = 3;
constexpr double k_most_ticks = 9;

/// Returns `mantissas` times every `stride`-th power of ten, within the axis.
std::vector<double> multiples(const LogAxis& axis, std::span<const double> mantissas, int stride) {
    std::vector<double> found;
    const int from = int(std::floor(std::log10(axis.low) / stride)) * stride;
    for (int power = from; std::pow(10.0, power) <= axis.high; power += stride)
        for (const double mantissa : mantissas)
            if (const double value = mantissa * std::pow(10.0, power);
                value >= axis.low && value <= axis.high)
                found.push_back(value);
    return found;
}

/// Returns evenly spaced round numbers, for an axis whose ends differ by a factor of about two.
std::vector<double> round_numbers(const LogAxis& axis) {
    const double wanted = (axis.high - axis.low) / 4;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    const double step = power * (wanted < 2 * power ? 1 : wanted < 5 * power ? 2 : 5);
    std::vector<double> found;
    const auto last = int(std::floor(axis.high / step));
    for (auto n = int(std::ceil(axis.low / step)); n <= last; ++n)
        found.push_back(n * step);
    return found;
}

std::string superscript(int number) {
    constexpr std::array k_digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(number))
        text += c == '-' ? "⁻" : k_digits[size_t(c - '0')];
    return text;
}

} // namespace

double LogAxis::pixel(double value) const {
    return first + (last - first) * (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

LogAxis log_axis(double least, double most, double first, double last) {
    const double span = std::max(std::log(most) - std::log(least), 0.1);
    const double factor = std::exp(k_room * span / (1 - 2 * k_room));
    using Limits = std::numeric_limits<double>;
    return {std::max(least / factor, Limits::min()), std::min(most * factor, Limits::max()), first, last};
}

std::vector<double> ticks(const LogAxis& axis) {
    constexpr std::array k_one{1.0};
    constexpr std::array k_three{1.0, 2.0, 5.0};
    const double decades = std::log10(axis.high) - std::log10(axis.low);
    auto found = multiples(axis, k_one, std::max(1, int(std::ceil(decades / k_most_ticks))));
    if (found.size() < k_fewest_ticks)
        found = multiples(axis, k_three, 1);
    return found.size() < k_fewest_ticks ? round_numbers(axis) : found;
}

std::string tick_text(double value) {
    const int power = int(std::floor(std::log10(value) + 1e-9));
    if (power > -4 && power < 5)
        return fmt::format("{:.4g}", value);
    const std::string mantissa = fmt::format("{:.4g}", value / std::pow(10.0, power));
    return (mantissa == "1" ? "" : mantissa + "·") + "10" + superscript(power);
}

namespace {

/// Distance from the middle of a mark to its label, pixels.
constexpr double k_distance = 8;

/// Returns eight places around a mark, the preferred ones first.
std::array<Box, 8> places(const Label& label) {
    const auto at = [&](double left, double top) {
        return Box{left, top, left + label.width, top + k_label_height};
    };
    const double right = label.x + k_distance, left = label.x - k_distance - label.width;
    const double above = label.y - k_distance - k_label_height, below = label.y + k_distance;
    const double middle = label.y - k_label_height / 2, centre = label.x - label.width / 2;
    return {at(right, above),  at(right, below),  at(left, above),   at(left, below),
            at(centre, above), at(centre, below), at(right, middle), at(left, middle)};
}

} // namespace

std::vector<std::optional<Box>> place_labels(std::span<const Label> labels, std::span<const Box> obstacles,
                                             const Box& bounds) {
    std::vector<Box> taken(obstacles.begin(), obstacles.end());
    std::vector<std::optional<Box>> placed;
    for (const Label& label : labels) {
        const auto tried = places(label);
        const auto free = std::ranges::find_if(tried, [&](const Box& place) {
            return bounds.holds(place) &&
                   std::ranges::none_of(taken, [&](const Box& box) { return place.overlaps(box); });
        });
        placed.push_back(free == tried.end() ? std::nullopt : std::optional(*free));
        if (placed.back())
            taken.push_back(*placed.back());
    }
    return placed;
}

namespace {

constexpr size_t k_colours = 7;
/// Outlines around the origin with about the same area. The first seven series differ in both colour and
/// shape; 56 differ in one of them.
constexpr std::array<std::string_view, 8> k_shapes{"M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0Z",
                                                   "M-4.5-4.5h9v9h-9Z",
                                                   "M0-6L5.6 4h-11.2Z",
                                                   "M0-6.2L6.2 0L0 6.2L-6.2 0Z",
                                                   "M0 6L5.6-4h-11.2Z",
                                                   "M-5.5-5.5h11l-11 11h11Z",
                                                   "M-4-5.6L6 0L-4 5.6Z",
                                                   "M4-5.6L-6 0L4 5.6Z"};
constexpr std::string_view k_cross = "M-2-6h4v4h4v4h-4v4h-4v-4h-4v-4h4Z"; ///< of the reference series
constexpr double k_mark = 6;                                              ///< half its size, pixels
constexpr double k_letter = 6.6; ///< width of a letter in a label, pixels
constexpr double k_gap = 4;      ///< between two labels, pixels
constexpr size_t k_longest = 28; ///< most letters of a label
constexpr Box k_margins{58, 12, 14, 44};

struct ShortText {
    std::string text;
    size_t letters = 0;
};

/// Cuts a text to `k_longest` characters of UTF-8, with an ellipsis if it was longer.
ShortText shortened(std::string_view text) {
    size_t letters = 0;
    for (size_t i = 0; i < text.size(); ++i)
        if (!continues_character(text[i]) && ++letters > k_longest)
            return {std::string(text.substr(0, i)) + "…", letters};
    return {std::string(text), letters};
}

std::string colour(size_t series) {
    return fmt::format("series-{}", series == 0 ? 0 : 1 + (series - 1) % k_colours);
}

/// Returns ticks that are at least `apart` pixels apart.
std::vector<double> thinned(const LogAxis& axis, double apart) {
    std::vector<double> kept;
    for (const double value : ticks(axis))
        if (kept.empty() || std::abs(axis.pixel(value) - axis.pixel(kept.back())) >= apart)
            kept.push_back(value);
    return kept;
}

class Diagram {
public:
    Diagram(const ScatterPlot& plot, Extent size)
        : plot_(plot), size_(size), frame_{k_margins.left, k_margins.top, size.width - k_margins.right,
                                           size.height - k_margins.bottom} {
        const auto& points = plot.points;
        const auto least = [&](auto field) { return std::ranges::min(points, {}, field).*field; };
        const auto most = [&](auto field) { return std::ranges::max(points, {}, field).*field; };
        x_ = log_axis(least(&ScatterPoint::x_low), most(&ScatterPoint::x_high), frame_.left, frame_.right);
        y_ = log_axis(least(&ScatterPoint::y), most(&ScatterPoint::y), frame_.bottom, frame_.top);
    }

    std::string draw(const std::string& form) const {
        const auto axis = [](const LogAxis& a) {
            return fmt::format("{:.9g} {:.9g} {:.1f} {:.1f}", a.low, a.high, a.first, a.last);
        };
        return fmt::format("<svg class=\"diagram {}\" viewBox=\"0 0 {} {}\" role=\"group\" aria-label=\"{}\" "
                           "data-x=\"{}\" data-y=\"{}\">\n",
                           form, size_.width, size_.height, escaped(plot_.name), axis(x_), axis(y_)) +
               grid() + front() + lines() + intervals() + labels() + marks() + "</svg>\n";
    }

private:
    double x(const ScatterPoint& point) const { return x_.pixel(point.x); }
    double y(const ScatterPoint& point) const { return y_.pixel(point.y); }

    std::string grid() const {
        std::string text = "<g class=\"grid\">\n";
        for (const double value : thinned(x_, 44))
            text += fmt::format(
                "<path d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" class=\"middle\">{4}</text>\n",
                x_.pixel(value), frame_.top, frame_.bottom, frame_.bottom + 17, tick_text(value));
        for (const double value : thinned(y_, 22))
            text += fmt::format(
                "<path d=\"M{0} {1:.1f}H{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" class=\"end\">{5}</text>\n",
                frame_.left, y_.pixel(value), frame_.right, frame_.left - 7, y_.pixel(value) + 4,
                tick_text(value));
        return text +
               fmt::format(
                   "<text x=\"{}\" y=\"{}\" class=\"middle name\">{}</text>\n"
                   "<text transform=\"translate(13 {}) rotate(-90)\" class=\"middle name\">{}</text></g>\n",
                   (frame_.left + frame_.right) / 2, size_.height - 6, escaped(plot_.x_name),
                   (frame_.top + frame_.bottom) / 2, escaped(plot_.y_name));
    }

    /// Draws the front as a staircase: the least error for a cost, which steps down at each point.
    std::string front() const {
        std::vector<ScatterPoint> points = plot_.points;
        std::erase_if(points, [](const ScatterPoint& point) { return !point.front; });
        std::ranges::sort(points, {}, &ScatterPoint::x);
        std::string path;
        for (const ScatterPoint& point : points)
            path += path.empty() ? fmt::format("M{:.1f} {:.1f}", x(point), y(point))
                                 : fmt::format("H{:.1f}V{:.1f}", x(point), y(point));
        return path.empty() ? path : fmt::format("<path class=\"front\" d=\"{}\"/>\n", path);
    }

    /// Draws a line through each series, in the order of its points.
    std::string lines() const {
        std::vector<std::string> paths;
        for (const ScatterPoint& point : plot_.points) {
            paths.resize(std::max(paths.size(), point.series + 1));
            std::string& path = paths[point.series];
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(point), y(point));
        }
        std::string text;
        for (size_t i = 0; i < paths.size(); ++i)
            if (paths[i].find('L') != std::string::npos)
                text += fmt::format("<path class=\"line {}\" data-series=\"{}\" d=\"{}\"/>\n", colour(i), i,
                                    paths[i]);
        return text;
    }

    std::string intervals() const {
        std::string text;
        for (const ScatterPoint& point : plot_.points)
            if (point.x_high > point.x_low)
                text += fmt::format(
                    "<path class=\"interval {}\" data-point=\"{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n",
                    colour(point.series), point.id, x_.pixel(point.x_low), y(point), x_.pixel(point.x_high));
        return text;
    }

    /// Returns what labels must not cover: marks and intervals.
    std::vector<Box> obstacles() const {
        std::vector<Box> boxes;
        for (const ScatterPoint& point : plot_.points) {
            boxes.push_back({x(point) - k_mark, y(point) - k_mark, x(point) + k_mark, y(point) + k_mark});
            boxes.push_back({x_.pixel(point.x_low), y(point) - 1, x_.pixel(point.x_high), y(point) + 1});
        }
        return boxes;
    }

    /// Draws labels; points of the front come first if not all fit.
    std::string labels() const {
        std::vector<ScatterPoint> points = plot_.points;
        std::ranges::stable_sort(points, std::ranges::greater(), &ScatterPoint::front);
        std::vector<Label> wanted;
        for (const ScatterPoint& point : points)
            wanted.push_back({x(point), y(point), k_letter * double(shortened(point.label).letters) + k_gap});
        const auto placed = place_labels(wanted, obstacles(), frame_);
        std::string text;
        for (size_t i = 0; i < placed.size(); ++i)
            if (placed[i])
                text += fmt::format(
                    "<text class=\"label\" data-point=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                    points[i].id, placed[i]->left, placed[i]->bottom - 3,
                    escaped(shortened(points[i].label).text));
        return text;
    }

    std::string marks() const {
        std::string text;
        for (const ScatterPoint& point : plot_.points)
            text += fmt::format(
                "<a class=\"mark\" href=\"#point-{0}\" data-point=\"{0}\" transform=\"translate({1:.1f} "
                "{2:.1f})\" "
                "aria-label=\"{3}\"><title>{3}</title><circle r=\"11\" class=\"reach\"/>{4}</a>\n",
                point.id, x(point), y(point), escaped(point.title), mark_of(point.series, point.hollow));
        return text;
    }

    const ScatterPlot& plot_;
    Extent size_;
    Box frame_;
    LogAxis x_, y_;
};

} // namespace

std::string mark_of(size_t series, bool hollow) {
    return fmt::format(R"(<path class="shape {}{}" d="{}"/>)", colour(series), hollow ? " hollow" : "",
                       series == 0 ? k_cross : k_shapes[(series - 1) % k_shapes.size()]);
}

std::string to_svg(const ScatterPlot& plot, Extent size, const std::string& form) {
    return plot.points.empty() ? std::string() : Diagram(plot, size).draw(form);
}

} // namespace tidemark::report

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

using scene::Json;

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
