#include "lsp/comments.hpp"

#include "base/trimmed.hpp"
#include "text/lines.hpp"

#include <algorithm>
#include <vector>

namespace tidemark::lsp {
namespace {

/// Returns the line without its comment marks: `//`, `/**`, `*`, `///<` and the like.
std::string_view without_marks(std::string_view line) {
    line = trimmed(line);
    if (line.ends_with("*/"))
        line.remove_suffix(2);
    line.remove_prefix(std::min(line.find_first_not_of("/*!<"), line.size()));
    return trimmed(line);
}

bool is_line_comment(std::string_view line) {
    return trimmed(line).starts_with("//");
}

template <class Range>
std::string joined(const Range& lines) {
    std::string comment;
    for (const std::string_view line : lines)
        if (const auto words = without_marks(line); !words.empty())
            comment += (comment.empty() ? "" : "\n") + std::string(words);
    return comment;
}

} // namespace

std::string comment_above(std::string_view text, size_t offset) {
    size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
    std::vector<std::string_view> lines; // from bottom to top, only as far as the comment reaches
    const auto take_line = [&] {
        const size_t end = begin - 1;
        begin = end == 0 ? 0 : text.rfind('\n', end - 1) + 1;
        lines.push_back(text.substr(begin, end - begin));
        return lines.back();
    };
    if (begin == 0)
        return {};
    if (trimmed(take_line()).ends_with("*/")) {
        while (begin > 0 && lines.back().find("/*") == lines.back().npos)
            take_line();
        if (!trimmed(lines.back()).starts_with("/*")) // a comment after code
            return {};
    } else {
        while (is_line_comment(lines.back()) && begin > 0)
            take_line();
        if (!is_line_comment(lines.back()))
            lines.pop_back();
    }
    std::ranges::reverse(lines);
    return joined(lines);
}

std::string leading_comment(std::string_view text) {
    const auto lines = text::lines_of(text);
    if (lines.empty())
        return {};
    auto end = lines.begin();
    if (trimmed(lines.front()).starts_with("/*"))
        end =
            std::min(std::ranges::find_if(lines, [](auto line) { return line.find("*/") != line.npos; }) + 1,
                     lines.end());
    else
        end = std::ranges::find_if_not(lines, is_line_comment);
    return joined(std::vector(lines.begin(), end));
}

} // namespace tidemark::lsp
