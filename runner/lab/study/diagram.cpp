#include "lab/study/diagram.hpp"

#include "lab/study/one_line.hpp"

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

} // namespace tidemark::lab
