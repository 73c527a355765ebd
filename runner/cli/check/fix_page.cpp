#include "cli/check/fix_page.hpp"

#include "cli/output_name.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

using report::escaped;
using report::escaped_lines;

/// Returns the text after its first line, which is the finding and serves as the heading.
std::string measured(const CureCard& cure) {
    return cure.text.substr(std::min(cure.text.size(), cure.finding.size() + 1));
}

std::string article(const CureCard& cure) {
    return fmt::format("<article class=\"finding pass\">\n<div>\n<h3>{}</h3>\n<pre>{}</pre>\n<pre>{}</pre>\n"
                       "</div>\n</article>\n",
                       escaped(cure.finding), escaped_lines(measured(cure)), escaped_lines(cure.difference));
}

std::string section(const char* heading, const std::string& body) {
    return body.empty() ? "" : fmt::format("<h2>{}</h2>\n{}", heading, body);
}

} // namespace

std::string fix_page(const std::string& scene, std::span<const CureCard> cures,
                     std::span<const RemainingCard> remaining, const std::string& cut) {
    std::string mended, left;
    for (const CureCard& cure : cures)
        mended += article(cure);
    for (const RemainingCard& each : remaining)
        left += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(each.finding), escaped(each.why));
    if (!left.empty())
        left = "<dl class=\"rows\">\n" + left + "</dl>\n";
    if (!cut.empty())
        left += fmt::format("<p>{}</p>\n", escaped(cut));
    const std::string name = name_after_scene(scene, "");
    return report::make_page(
        {name + ": what could be written instead", name,
         fmt::format("What could be written instead? {} cure{}, each measured on top of those before; {} "
                     "finding{} not mended.",
                     cures.size(), cures.size() == 1 ? "" : "s", remaining.size(),
                     remaining.size() == 1 ? " is" : "s are"),
         section("Cures", mended) + section("Not mended", left)});
}

} // namespace tidemark::cli
