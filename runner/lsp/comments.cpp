#include "lsp/comments.hpp"

#include "base/trimmed.hpp"
#include "text/lines.hpp"

#include <algorithm>
#include <vector>

namespace tidemark::lsp {
namespace {

/// Without `//`, `/**`, `*` and their kind; `///<` too.
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
    const size_t line_begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
    const auto lines = text::lines_of(text.substr(0, line_begin));
    auto first = lines.end();
    if (first == lines.begin())
        return {};
    if (trimmed(*(first - 1)).ends_with("*/")) {
        do
            --first;
        while (first != lines.begin() && first->find("/*") == first->npos);
        if (!trimmed(*first).starts_with("/*")) // it stands behind code
            return {};
    } else {
        while (first != lines.begin() && is_line_comment(*(first - 1)))
            --first;
    }
    return joined(std::vector(first, lines.end()));
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
