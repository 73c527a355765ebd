#include "lab/study_report.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "base/process.hpp"
#include "lab/study_data.hpp"
#include "lab/study_page.hpp"
#include "media/comparison.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// M. Okabe and K. Ito's colours, distinguishable for the colour-blind, and P. Tol's wine.
constexpr const char* k_colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                     "#e69f00", "#56b4e9", "#7f7f00", "#882255"};
constexpr const char* k_grey = "#555555";

/// Quotes text for gnuplot: between apostrophes, backquotes run no command. Apostrophes in the text become
/// typographic ones, because two for one, as the manual has it, end a string that they begin.
std::string quoted_text(std::string_view text) {
    std::string quoted = "'";
    for (const char c : one_line(text))
        quoted += c == '\'' ? "\u2019" : std::string(1, c);
    return quoted + "'";
}

/// Quotes a column of a data block: nothing in it is a command, but a line EOD would end the block, and a
/// quote the column.
std::string data_text(std::string_view text) {
    std::string word = "\"";
    for (const char c : one_line(text))
        word += c == '"' || c == '\\' ? '\'' : c;
    return word + '"';
}

struct Mark {
    double cost, low, high, error;
    bool hollow, front;
    std::string label;
};

std::vector<Mark> marks_of(const WorkPrecisionSet& set, Across across, size_t series) {
    std::vector<Mark> marks;
    for (const WorkPrecision& point : set.points) {
        if (point.point.series != series || !point.measured())
            continue;
        const TimeSummary& time = point.all.time();
        const double work = point.all.hits ? point.all.hits->evaluations : 0;
        Mark mark{time.median,  time.confidence.low, time.confidence.high, error_of(set, point.all),
                  point.hollow, point.on_front,      point.point.knob};
        if (across == Across::work)
            mark.cost = mark.low = mark.high = work;
        if (mark.cost > 0 && mark.error > 0 && std::isfinite(mark.error))
            marks.push_back(std::move(mark));
    }
    return marks;
}

std::string block(const std::string& name, const std::vector<Mark>& marks) {
    std::string text = fmt::format("${} << EOD\n", name);
    for (const Mark& mark : marks)
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {} {}\n", mark.cost, mark.error, mark.low, mark.high,
                            mark.hollow ? 1 : 0, data_text(mark.label));
    return text + "EOD\n";
}

/// Returns the front as a staircase, one step down at each point.
std::string front(std::vector<Mark> marks) {
    std::erase_if(marks, [](const Mark& mark) { return !mark.front; });
    std::ranges::sort(marks, {}, &Mark::cost);
    return block("front", marks);
}

std::string plot_of(const std::string& name, const std::string& title, const char* colour, Across across) {
    std::string text =
        fmt::format("  ${0} using 1:2 with lines lw 1.2 lc rgb '{1}' notitle, \\\n", name, colour);
    if (across == Across::time)
        text += fmt::format("  ${0} using 1:2:3:4 with xerrorbars pt -1 lw 1 lc rgb '{1}' notitle, \\\n",
                            name, colour);
    text += fmt::format("  ${0} using ($5==0?$1:NaN):2 with points pt 7 ps 0.9 lc rgb '{1}' title {2}, \\\n"
                        "  ${0} using ($5==1?$1:NaN):2 with points pt 6 ps 0.9 lc rgb '{1}' notitle, \\\n"
                        "  ${0} using 1:2:6 with labels left offset 0.7,{3} font ',10' tc rgb '{1}' notitle",
                        name, colour, quoted_text(title), colour == k_grey ? -0.6 : 0.5);
    return text;
}

} // namespace

std::string diagram_script(const WorkPrecisionSet& set, Across across, const std::string& name) {
    std::string blocks, plots;
    std::vector<Mark> all;
    for (size_t i = 0; i <= set.study.series.size(); ++i) {
        const std::vector<Mark> marks = marks_of(set, across, i);
        if (marks.empty())
            continue;
        const bool own = i < set.study.series.size();
        const std::string block_name = fmt::format("s{}", i);
        std::string title = own ? set.study.series[i].name : set.words.defaults;
        if (own && set.study.series[i].trust != Trust::unknown)
            title += fmt::format(" ({})", to_string(set.study.series[i].trust));
        blocks += block(block_name, marks);
        plots += (plots.empty() ? "" : ", \\\n") +
                 plot_of(block_name, title, own ? k_colours[i % std::size(k_colours)] : k_grey, across);
        all.insert(all.end(), marks.begin(), marks.end());
    }
    if (all.empty())
        return {};
    std::string script = "set encoding utf8\nset logscale xy\nset format '%g'\nset grid lc rgb '#dddddd'\n"
                         "set key below noenhanced\nset border lc rgb '#666666'\n";
    // The empty line keeps the legend off the label.
    script += fmt::format("set xlabel {}.\"\\n\"\nset ylabel {} noenhanced\n",
                          across == Across::time ? "'milliseconds, median with 95 % interval'"
                                                 : quoted_text(set.words.work),
                          quoted_text(error_name(set)));
    script += blocks;
    if (across == Across::time) {
        script += front(all);
        plots = "  $front using 1:2 with steps lw 6 lc rgb '#e8e8d0' title 'front', \\\n" + plots;
    }
    for (const auto& [ending, terminal] :
         {std::pair{"svg", "svg size 1000,600 font 'sans-serif,13' noenhanced background '#ffffff'"},
          {"png", "pngcairo size 1000,600 font 'sans,11' noenhanced background '#ffffff'"}})
        script +=
            fmt::format("set terminal {}\nset output '{}.{}'\nplot \\\n{}\n", terminal, name, ending, plots);
    return script + "unset output\n";
}

namespace fs = std::filesystem;
namespace {

/// Limit for all pictures embedded in the page, in bytes; the others are links to their files.
constexpr size_t k_most_embedded = size_t{16} << 20;

class Report {
public:
    Report(const OutputPath& folder, Findings& findings)
        : folder_(folder), set_(findings.set), evidence_(findings.evidence) {}

    /// Creates all contents before it writes the first file, so a report that fails leaves an older one
    /// intact.
    Result<void> write() {
        make_diagrams();
        if (auto done = make_maps(); !done)
            return done;
        // last, because they contain the remarks of all other parts
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
            if (auto done = file.write(std::as_bytes(std::span(bytes))); !done)
                return done;
            staged.push_back(std::move(file));
        }
        for (StagedFile& file : staged)
            if (auto done = file.commit(); !done)
                return done;
        return {};
    }

    void remark(std::string text) {
        auto& remarks = set_.circumstances.remarks;
        if (std::ranges::find(remarks, text) == remarks.end())
            remarks.push_back(std::move(text));
    }

    void make_diagrams() {
        make_diagram(Across::time, "error-vs-time");
        if (set_.has_hits())
            make_diagram(Across::work, "error-vs-work");
    }

    /// The script is always written, so it can be run elsewhere if gnuplot is missing here.
    void make_diagram(Across across, const std::string& name) {
        const std::string script = diagram_script(set_, across, name);
        if (script.empty()) {
            remark(fmt::format("{} has no point: every error is 0 or unknown, or nothing was timed", name));
            return;
        }
        add(name + ".gp", script);
        const ScratchFolder scratch;
        const fs::path file = scratch.path() / (name + ".gp");
        std::string folder = scratch.path().string();
        for (size_t at = 0; (at = folder.find('\'', at)) != folder.npos; at += 2)
            folder.insert(at, 1, '\'');
        const auto written = write_file(file, script);
        const auto drawn =
            written ? output_of({"gnuplot", "-d", "-e", fmt::format("cd '{}'", folder), file.string()},
                                {size_t{1} << 16}, "; install the package gnuplot-nox")
                    : Result<std::string>(fail(written.error()));
        if (!drawn) {
            remark(fmt::format("no diagrams: {} (the data are in points.csv, the script is {}.gp)",
                               drawn.error().message, name));
            return;
        }
        for (const char* ending : {".svg", ".png"})
            if (auto picture = read_file(scratch.path() / (name + ending)))
                add(name + ending, *std::move(picture));
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
    WorkPrecisionSet& set_;
    const Evidence& evidence_;
    PageMedia media_;
    ScratchFolder scratch_;
    size_t embedded_ = 0; ///< bytes of pictures in the page
    using File = std::pair<fs::path, std::string>;
    std::vector<File> files_; ///< names in the folder, and contents
};

} // namespace

Result<void> write_report(const OutputPath& folder, Findings& findings) {
    return Report(folder, findings).write();
}

} // namespace tidemark::lab
