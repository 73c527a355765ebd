#include "lab/report_page.hpp"

#include <fmt/format.h>

namespace tidemark::report {

// The files of page/, embedded in the program (runner/CMakeLists.txt).
extern const std::string_view k_page;    ///< page.html
extern const std::string_view k_limits;  ///< limits.html
extern const std::string_view k_compare; ///< compare.html
extern const std::string_view k_style;   ///< style.css
extern const std::string_view k_scripts; ///< copy.js and compare.js
extern const std::string_view k_explore; ///< the scripts of a diagram, concatenated

namespace {

std::string safe_character(char c) {
    switch (c) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    case '\'': return "&#39;";
    case 0x7F: return " ";
    default: return static_cast<unsigned char>(c) < 0x20 ? " " : std::string(1, c);
    }
}

} // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text)
        safe += safe_character(c);
    return safe;
}

std::string escaped_lines(std::string_view text) {
    std::string safe;
    for (const char c : text)
        safe += c == '\n' ? "\n" : safe_character(c);
    return safe;
}

std::string in_script(std::string_view json) {
    std::string safe;
    for (const char c : json)
        safe += c == '<' ? "\\u003c" : std::string(1, c);
    return safe;
}

std::string filled(std::string_view form, std::initializer_list<Filling> fillings) {
    std::string page;
    for (const auto& [mark, text] : fillings) {
        const size_t at = form.find(mark);
        page.append(form.substr(0, at)).append(text);
        form.remove_prefix(at + mark.size());
    }
    return page.append(form);
}

std::string limits_form(const std::string& error_name) {
    return filled(k_limits, {{"{{error}}", escaped(error_name)}});
}

std::string comparison_form(const std::string& note, const std::string& reference) {
    return filled(k_compare, {{"{{note}}", escaped(note)}, {"{{reference}}", reference}});
}

namespace {

std::string scripts(const Page& page) {
    std::string text = fmt::format("<script type=\"module\">\n{}</script>\n", k_scripts);
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
