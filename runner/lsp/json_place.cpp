#include "lsp/json_place.hpp"

#include "scene/project.hpp"

#include <algorithm>
#include <string>

namespace tidemark::lsp {
namespace {

size_t end_of_string(std::string_view json, size_t begin) {
    size_t at = begin;
    while (at < json.size() && json[at] != '"')
        at += json[at] == '\\' ? 2 : 1;
    return std::min(at, json.size());
}

/// Returns the inside of the string value of the n-th key "code", from 0, with its escapes. The JSON must be
/// valid.
std::optional<std::pair<size_t, size_t>> find_code(std::string_view json, size_t n) {
    for (size_t at = json.find('"'); at != json.npos; at = json.find('"', at)) {
        const size_t end = end_of_string(json, at + 1);
        const bool is_code = json.substr(at + 1, end - at - 1) == "code";
        at = std::min(end + 1, json.size());
        const size_t colon = json.find_first_not_of(" \t\r\n", at);
        if (!is_code || colon == json.npos || json[colon] != ':')
            continue;
        const size_t value = json.find_first_not_of(" \t\r\n", colon + 1);
        if (value == json.npos || json[value] != '"')
            continue;
        if (n-- == 0)
            return std::pair(value + 1, end_of_string(json, value + 1));
        at = value;
    }
    return std::nullopt;
}

/// Returns the offset after the line end at `at`, or 0 if there is none: \n, \r or \r\n, escaped.
size_t after_line_end(std::string_view json, size_t at) {
    if (json.substr(at, 4) == "\\r\\n")
        return at + 4;
    const std::string_view two = json.substr(at, 2);
    return two == "\\n" || two == "\\r" ? at + 2 : 0;
}

} // namespace

std::optional<std::pair<size_t, size_t>> find_code_line(std::string_view json, std::string_view pass,
                                                        int line) {
    const auto project = scene::read_project(json, "");
    if (!project)
        return std::nullopt;
    const auto names = scene::pass_names(*project);
    const auto name = std::ranges::find(names, pass);
    const auto code = find_code(json, size_t(name - names.begin()));
    if (name == names.end() || !code)
        return std::nullopt;
    size_t begin = code->first, at = begin;
    while (at < code->second) {
        const size_t next = after_line_end(json, at);
        if (next == 0) {
            at += json[at] == '\\' ? 2 : 1;
            continue;
        }
        if (line == 1)
            break;
        --line;
        begin = at = next;
    }
    if (line == 1)
        return std::pair(begin, std::min(at, code->second));
    return std::nullopt;
}

} // namespace tidemark::lsp
