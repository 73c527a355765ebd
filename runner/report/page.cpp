#include "report/page.hpp"

#include "report/html.hpp"
#include "report/parts.hpp"

#include <fmt/format.h>

namespace tidemark::report {
namespace {

std::string scripts(const Page& page) {
    std::string text = fmt::format("<script type=\"module\">\n{}</script>\n", k_copy);
    if (!page.data.empty())
        text += fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n<script "
                            "type=\"module\">\n{}</script>\n",
                            in_script(page.data), k_explore);
    return text;
}

} // namespace

std::string make_page(const Page& page) {
    return filled(k_page, {{"{{title}}", escaped(page.title)},
                           {"{{style}}", k_style},
                           {"{{heading}}", escaped(page.heading)},
                           {"{{about}}", escaped(page.about)},
                           {"{{body}}", page.body},
                           {"{{scripts}}", scripts(page)}});
}

std::string command(const std::string& words) {
    return fmt::format("<div class=\"command\"><code>{}</code></div>\n", escaped(words));
}

std::string table(const std::string& name, const std::string& rows) {
    return fmt::format(
        "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\"><table>\n{}</table></div>\n",
        escaped(name), rows);
}

} // namespace tidemark::report
