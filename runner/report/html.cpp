#include "report/html.hpp"

namespace tidemark::report {
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

} // namespace tidemark::report
