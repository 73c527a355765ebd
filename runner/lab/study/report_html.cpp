#include "lab/study/report_html.hpp"

#include "lab/study/explorer.hpp"
#include "lab/study/report_method.hpp"
#include "lab/study/report_tables.hpp"
#include "lab/study/verdict.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace tidemark::lab {
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

} // namespace tidemark::lab
