#include "lab/study_report.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "lab/outcome.hpp"
#include "lab/report_page.hpp"
#include "lab/study_data.hpp"
#include "lab/study_explorer.hpp"
#include "lab/work_precision.hpp"
#include "media/comparison.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

namespace tidemark::lab {

std::string number(double value) {
    if (!std::isfinite(value))
        return std::isinf(value) ? "&infin;" : "&ndash;";
    if (value == 0)
        return "0";
    const int power = int(std::floor(std::log10(std::abs(value))));
    return power < -4 || power > 6 ? fmt::format("{:.2e}", value)
                                   : fmt::format("{:.{}f}", value, std::max(2 - power, 0));
}

std::string time_text(const TimeSummary& time) {
    const std::string interval =
        time.runs < k_fewest_runs
            ? fmt::format("[{} rounds]", time.runs)
            : fmt::format("[{}, {}]", number(time.confidence.low), number(time.confidence.high));
    return fmt::format("{} {}{}", number(time.median), interval, time.drifted ? " drift" : "");
}

std::string error_text(const WorkPrecisionSet& set, const Outcome& outcome) {
    const auto& own = standard_of(set).uncertainty;
    return number(error_of(set, outcome)) + (own ? " &plusmn; " + number(*own) : "");
}

// The tables of a study's page, as HTML.

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
    columns.push_back({"minimum ms", [](const WorkPrecision& p) { return number(p.all.time().smallest); }});
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

/// Returns a row for each point, with the numbers of all views together and a link to the point's card.
std::string points_table(const WorkPrecisionSet& set) {
    const std::vector<Column> columns = columns_of(set);
    std::string rows = "<tr><th>setting</th>";
    for (const Column& column : columns)
        rows += fmt::format("<th>{}</th>", column.head);
    rows += "</tr>\n";
    for (size_t i = 0; i < set.points.size(); ++i)
        rows += point_row(set, columns, i);
    return report::table("Settings and their numbers", rows) +
           "<p class=\"note\">Marked rows: the front, where no setting here is both cheaper and more exact. "
           "&#9675;: hollow, the error is under ten times the reference's own.</p>\n";
}

/// Returns the error and time of each point in each view.
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

/// Returns the shares of the error, with a heading; empty if no error source was removed.
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
        "<h2>What the error is made of</h2>\n<p class=\"note\">Error sources are removed one after another; "
        "each column is the change that this made ({}), the last column the remaining error.</p>\n{}",
        set.has_hits() ? "RMS of t / RMSE of the picture" : "RMSE of the picture",
        report::table("Sources of error", "<tr><th>setting</th>" + head + "</tr>\n" + rows));
}

/// Returns the causes of wrong hits, with a heading; empty if they are not known.
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

// Describes as HTML how a study's figures were measured: truths, clock, machine, scene, observed orders,
// omissions.

std::string method(const WorkPrecisionSet& set);

namespace {

using report::escaped;

std::string list(const std::vector<std::string>& items) {
    std::string html = "<ul>\n";
    for (const std::string& item : items)
        html += fmt::format("<li>{}</li>\n", escaped(item));
    return html + "</ul>\n";
}

std::string standard(const char* name, const Standard& standard) {
    if (!standard.none.empty())
        return fmt::format("<dt>Reference of the {}</dt><dd>none: {}.</dd>\n", name, escaped(standard.none));
    return fmt::format(
        "<dt>Reference of the {}</dt><dd>{}.<br>Its own error: {}; self-check: {}.{}</dd>\n", name,
        escaped(standard.method),
        standard.uncertainty ? figure(*standard.uncertainty) : std::string("unknown"),
        escaped(standard.check),
        standard.blind > 0
            ? fmt::format("<br>It is NaN or infinite in {} pixels, whose error is unknown.", standard.blind)
            : std::string());
}

std::string held(const WorkPrecisionSet& set) {
    std::string items;
    for (const Setting& setting : set.held)
        items += fmt::format("{}{} = {}", items.empty() ? "" : ", ", setting.name, setting.value);
    if (items.empty())
        return {};
    return fmt::format("<dt>Held fixed</dt><dd>{}. The reference has the same values, so their error is not "
                       "measured.</dd>\n",
                       escaped(items));
}

} // namespace

/// Returns an empty text if no curve has enough points.
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
    return "<h2>How fast the error falls</h2>\n<p>The power of the knob with which the error falls, over "
           "points that are not hollow.</p>\n" +
           list(items);
}

std::string method(const WorkPrecisionSet& set) {
    const Circumstances& facts = set.circumstances;
    std::string html = "<h2>How it was measured</h2>\n<dl class=\"facts\">\n";
    if (set.has_hits())
        html += standard("hits", set.hit_standard);
    if (set.has_pictures())
        html += standard("pictures", set.picture_standard);
    html += held(set);
    html += fmt::format("<dt>Time</dt><dd>{}; {} warm-up rounds, then {} rounds; each round draws every "
                        "setting once in every view, in a newly shuffled order (fixed seed); a slow setting "
                        "skips rounds. Medians with 95 % bootstrap intervals; compiling and the first draw "
                        "are separate. &ldquo;All&rdquo; is the mean over the views of each round.</dd>\n",
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

/// Returns an empty text if nothing was left out.
std::string left_out(const WorkPrecisionSet& set) {
    std::vector<std::string> items = set.study.omissions;
    items.insert(items.end(), set.circumstances.remarks.begin(), set.circumstances.remarks.end());
    return items.empty() ? std::string() : "<h2>Left out</h2>\n" + list(items);
}

namespace {

/// Returns the name of the scene's file or folder, without its path and extension.
std::string name_of(const WorkPrecisionSet& set) {
    const std::filesystem::path scene = set.circumstances.scene;
    return (scene.has_filename() ? scene : scene.parent_path()).stem().string();
}

std::string verdict(const WorkPrecisionSet& set) {
    std::string html =
        fmt::format("<div class=\"verdict{}\">\n", set.circumstances.complete ? "" : " warning");
    for (const std::string& sentence : sentences(set))
        html += fmt::format("<p>{}</p>\n", report::escaped(sentence));
    return html + "</div>\n";
}

} // namespace

std::string to_html(const WorkPrecisionSet& set, const PageMedia& media) {
    const std::string name = name_of(set);
    const std::string subject = set.study.about.empty() ? "" : " " + set.study.about;
    return report::make_page({name + ": error against run time", name, "Error against run time." + subject,
                              verdict(set) + "<h2>Error against cost</h2>\n" + explorer(set, media) +
                                  comparison(media) + "<h2>Settings</h2>\n" + points_table(set) +
                                  views_table(set) + orders(set) + causes_table(set) + shares_table(set) +
                                  method(set) + left_out(set),
                              explorer_data(set)});
}

namespace fs = std::filesystem;
namespace {

/// Limit for all pictures embedded in the page, in bytes; the others are links to their files.
constexpr size_t k_most_embedded = size_t{16} << 20;

class Report {
public:
    Report(const OutputPath& folder, const Findings& findings)
        : folder_(folder), set_(findings.set), evidence_(findings.evidence) {}

    /// Creates all contents before it writes the first file, so a report that fails leaves an older one
    /// intact.
    Result<void> write() {
        TRY(make_maps());
        add("points.csv", to_csv(set_));
        add("report.html", to_html(set_, media_));
        add("study.json", to_json(set_));
        return put_files();
    }

private:
    void add(fs::path name, std::string bytes) { files_.emplace_back(std::move(name), std::move(bytes)); }

    Result<void> put_files() const {
        std::vector<StagedFile> staged;
        for (const auto& [name, bytes] : files_) {
            if (auto made = make_folder(name.has_parent_path() ? folder_ / name.parent_path() : folder_);
                !made)
                return made;
            auto file = TRY(StagedFile::create(folder_ / name));
            TRY(file.write(std::as_bytes(std::span(bytes))));
            staged.push_back(std::move(file));
        }
        for (StagedFile& file : staged)
            TRY(file.commit());
        return {};
    }

    /// Returns the view with the largest error of the unchanged scene, in which differences are most visible.
    size_t shown_view() const {
        const auto& views = set_.points.front().views;
        const auto worst = std::ranges::max_element(
            views, {}, [&](const Outcome& outcome) { return outcome.picture.samples.rmse; });
        return worst == views.end() ? 0 : size_t(worst - views.begin());
    }

    /// Keeps a picture as `maps/NAME.png`, and embeds it in the page within the limit.
    Result<PagePicture> keep(const std::string& label, const std::string& name, const image::Image& picture) {
        const fs::path file = scratch_.path() / (name + ".png");
        TRY(image::write_picture(file, picture));
        auto bytes = TRY(read_file(file, size_t{1} << 30));
        PagePicture kept{label, "maps/" + name + ".png", {}};
        if (embedded_ + bytes.size() <= k_most_embedded) {
            embedded_ += bytes.size();
            kept.source = "data:image/png;base64," + base64(bytes);
        }
        add(kept.file, std::move(bytes));
        return kept;
    }

    /// Returns a point's picture, its difference from the reference, and the causes of wrong hits.
    Result<std::vector<PagePicture>> maps_of(size_t point, size_t view) {
        std::vector<PagePicture> maps;
        if (!set_.points[point].measured())
            return maps;
        const image::Image& picture = evidence_.pictures[point][view];
        const auto flip = image::heat_map(image::flip(evidence_.reference[view], picture).map);
        maps.push_back(TRY(keep("picture", fmt::format("{:02}-picture", point), picture)));
        maps.push_back(TRY(keep("FLIP", fmt::format("{:02}-flip", point), flip)));
        if (const auto& causes = evidence_.causes[point]; !causes.empty())
            maps.push_back(TRY(keep("causes", fmt::format("{:02}-causes", point), causes[view])));
        return maps;
    }

    Result<void> make_maps() {
        if (evidence_.reference.empty())
            return {};
        const size_t view = shown_view();
        media_.view = set_.study.views[view].name;
        media_.reference = TRY(keep("reference", "reference", evidence_.reference[view]));
        for (size_t i = 0; i < set_.points.size(); ++i)
            media_.points.push_back(TRY(maps_of(i, view)));
        return {};
    }

    const OutputPath& folder_;
    const WorkPrecisionSet& set_;
    const Evidence& evidence_;
    PageMedia media_;
    ScratchFolder scratch_;
    size_t embedded_ = 0; ///< bytes of pictures in the page
    using File = std::pair<fs::path, std::string>;
    std::vector<File> files_; ///< names in the folder, and contents
};

} // namespace

Result<void> write_report(const OutputPath& folder, const Findings& findings) {
    return Report(folder, findings).write();
}

} // namespace tidemark::lab
