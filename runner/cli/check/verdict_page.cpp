#include "cli/check/verdict_page.hpp"

#include "base/base64.hpp"
#include "base/file.hpp"
#include "cli/output_name.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace tidemark::cli {
namespace {

using lab::Verdict;
using report::escaped;

struct Group {
    Verdict verdict;
    const char* style; ///< class of page/style.css, and the group's anchor
    const char* heading;
};

/// The most urgent group first.
constexpr Group k_groups[] = {{Verdict::fail, "fail", "Failures"},
                              {Verdict::warn, "warn", "Warnings"},
                              {Verdict::cut, "cut", "Cut off by the budget"},
                              {Verdict::pass, "pass", "Passed"},
                              {Verdict::not_applicable, "not-applicable", "Not applicable"}};

using Results = std::vector<const ProbeResult*>;

Results of_verdict(std::span<const ProbeResult> all, Verdict verdict) {
    Results found;
    for (const ProbeResult& asked : all)
        if (asked.answer.verdict == verdict)
            found.push_back(&asked);
    return found;
}

/// Embeds the picture; probes draw small ones, so all fit into the page.
std::string picture(const ProbeResult& asked) {
    if (asked.picture.empty())
        return {};
    const auto bytes = read_file(asked.picture);
    if (!bytes)
        return {};
    return fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"what {} saw\"></figure>\n",
                       base64(*bytes), escaped(asked.probe->name));
}

std::string words(const ProbesRequest& request, const ProbeResult& asked) {
    std::string html =
        fmt::format("<h3>{} <span class=\"badge\">{}</span></h3>\n<p>{}</p>\n<p class=\"note\">{}.</p>\n",
                    escaped(asked.probe->name), lab::to_string(asked.answer.verdict),
                    escaped(asked.answer.sentence), escaped(asked.probe->about));
    if (!asked.trace.empty())
        html += fmt::format("<pre>{}</pre>\n", report::escaped_lines(asked.trace));
    if (const std::string command = reproduction(request, asked); !command.empty())
        html += report::command(command);
    return html;
}

std::string article(const ProbesRequest& request, const ProbeResult& asked, const char* style) {
    const std::string shown = picture(asked);
    return fmt::format("<article class=\"finding {}{}\" id=\"{}\">\n<div>\n{}</div>\n{}</article>\n", style,
                       shown.empty() ? "" : " pictured", escaped(asked.probe->name), words(request, asked),
                       shown);
}

/// Lists results, with probes that have the same sentence in one row.
std::string short_rows(const Results& results) {
    std::vector<std::pair<std::string, std::string>> rows; // probes, sentence
    for (const ProbeResult* asked : results) {
        const auto same =
            std::ranges::find(rows, asked->answer.sentence, &std::pair<std::string, std::string>::second);
        if (same == rows.end())
            rows.emplace_back(asked->probe->name, asked->answer.sentence);
        else
            same->first += fmt::format(", {}", asked->probe->name);
    }
    std::string html = "<dl class=\"rows\">\n";
    for (const auto& [probes, sentence] : rows)
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(probes), escaped(sentence));
    return html + "</dl>\n";
}

std::string section(const ProbesRequest& request, const Group& group, const Results& results) {
    std::string html = fmt::format("<h2 id=\"{}\">{}</h2>\n", group.style, group.heading);
    if (!is_finding(results.front()->answer))
        return html + short_rows(results);
    for (const ProbeResult* asked : results)
        html += article(request, *asked, group.style);
    return html;
}

} // namespace

std::string verdict_page(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds) {
    std::string counts, sections;
    for (const Group& group : k_groups) {
        const Results results = of_verdict(all, group.verdict);
        if (results.empty())
            continue;
        counts += fmt::format("<li><a class=\"{0}\" href=\"#{0}\"><b>{1}</b> {2}</a></li>\n", group.style,
                              results.size(), lab::to_string(group.verdict));
        sections += section(request, group, results);
    }
    const std::string name = name_after_scene(request.scene.path, "");
    return report::make_page({name + ": can its numbers be trusted?", name,
                              fmt::format("Can its numbers be trusted? {} probes in {:.1f} s: {}.",
                                          all.size(), seconds, counted(all)),
                              "<ul class=\"counts\">\n" + counts + "</ul>\n" + sections});
}

} // namespace tidemark::cli
