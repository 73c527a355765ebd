#include "cli/help_topics.hpp"

#include "base/encoding.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace tidemark::cli {
namespace {

/// Tables are set in columns if all but the last are at most this wide together.
constexpr size_t k_widest_columns = 40;

constexpr std::string_view k_section = "\n## ";

std::string name_of(std::string_view title) {
    std::string name;
    for (const char c : title) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += char(std::tolower(static_cast<unsigned char>(c)));
        else if (c == ' ')
            name += '-';
    }
    return name;
}

/// Returns the topic of a text that begins with its heading.
Topic topic_of(std::string_view markdown, bool whole_page) {
    const std::string_view heading = markdown.substr(0, markdown.find('\n'));
    const std::string_view title = heading.substr(heading.find(' ') + 1);
    return {name_of(title), markdown, whole_page};
}

/// Counts code points; each is one column in the characters that the pages use.
size_t width_of(std::string_view text) {
    return size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Replaces `[text](target)` and `**text**` by the text.
std::string without_marks(std::string_view line) {
    std::string text;
    while (!line.empty()) {
        const size_t middle = line.find("](");
        const size_t end = line.find(')', middle == line.npos ? line.size() : middle);
        if (line.starts_with("**")) {
            line.remove_prefix(2);
        } else if (line.front() == '[' && end != line.npos && line.find(']') == middle) {
            text += line.substr(1, middle - 1);
            line.remove_prefix(end + 1);
        } else {
            text += line.front();
            line.remove_prefix(1);
        }
    }
    return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

using Row = std::vector<std::string>;

/// Splits `| a | b |` into cells; `\|` is part of a cell.
Row cells_of(std::string_view line) {
    Row cells;
    std::string cell;
    for (size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
            cell += line[++i];
        } else if (line[i] == '|') {
            cells.push_back(cell.size() > 2 ? without_marks(cell.substr(1, cell.size() - 2)) : "");
            cell.clear();
        } else {
            cell += line[i];
        }
    }
    return cells;
}

std::string table_text(const std::vector<Row>& rows) {
    std::vector<size_t> widths(rows.front().size(), 0);
    for (const Row& row : rows)
        for (size_t i = 0; i + 1 < std::min(row.size(), widths.size()); ++i)
            widths[i] = std::max(widths[i], width_of(row[i]) + 2);
    const bool in_columns = std::accumulate(widths.begin(), widths.end(), size_t(0)) <= k_widest_columns;
    std::string text;
    for (const Row& row : rows) {
        for (size_t i = 0; i < row.size(); ++i) {
            if (!in_columns)
                text += i == 0 ? "  " + row[i] : "\n      " + row[i];
            else if (i + 1 < row.size())
                text += (i == 0 ? "  " : "") + row[i] + std::string(widths[i] - width_of(row[i]), ' ');
            else
                text += row[i];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

/// Converts a text line by line; the rows of a table are kept until it ends.
class PlainText {
public:
    void add(std::string_view line) {
        if (line.starts_with("```")) {
            in_code_ = !in_code_;
        } else if (in_code_) {
            text_.append("    ").append(line) += '\n';
        } else if (line.starts_with("<!--") || line.starts_with("|--") || line.find("![") != line.npos ||
                   line.find("<img") != line.npos) {
            return;
        } else if (line.starts_with('|')) {
            rows_.push_back(cells_of(line));
        } else {
            end_table();
            const size_t marks = line.starts_with('#') ? line.find(' ') + 1 : 0;
            text_ += without_marks(line.substr(marks)) + '\n';
        }
    }

    std::string finish() && {
        end_table();
        return std::move(text_);
    }

private:
    void end_table() {
        if (!rows_.empty())
            text_ += table_text(rows_);
        rows_.clear();
    }

    std::string text_;
    std::vector<Row> rows_;
    bool in_code_ = false;
};

} // namespace

std::vector<Topic> topics_of(std::span<const std::string_view> pages) {
    std::vector<Topic> topics;
    for (const std::string_view page : pages) {
        topics.push_back(topic_of(page, true));
        for (size_t at = page.find(k_section); at != page.npos;) {
            const size_t next = page.find(k_section, at + 1);
            topics.push_back(topic_of(page.substr(at + 1, next - at - 1), false));
            at = next;
        }
    }
    return topics;
}

std::string plain_text(std::string_view markdown) {
    PlainText plain;
    for (const std::string_view line : lines_of(markdown))
        plain.add(line);
    return std::move(plain).finish();
}

std::vector<Mention> mentions_of(std::string_view word, const std::vector<Topic>& topics) {
    constexpr size_t k_most = 10, k_longest_line = 100;
    const std::string wanted = lower_case(std::string(word));
    std::vector<std::pair<size_t, Mention>> counted;
    for (const Topic& topic : topics) {
        if (topic.whole_page && topic.markdown.find(k_section) != topic.markdown.npos)
            continue; // its sections are found by themselves
        size_t count = 0;
        std::string first;
        const std::string text = plain_text(topic.markdown);
        for (const std::string_view line : lines_of(text))
            if (lower_case(std::string(line)).find(wanted) != std::string::npos && count++ == 0)
                first = line.substr(std::min(line.find_first_not_of(' '), line.size()));
        if (count > 0)
            counted.push_back({count, {topic.name, cut_text(first, k_longest_line)}});
    }
    std::ranges::stable_sort(counted, std::ranges::greater(), &std::pair<size_t, Mention>::first);
    std::vector<Mention> mentions;
    for (auto& [count, mention] : counted)
        if (mentions.size() < k_most)
            mentions.push_back(std::move(mention));
    return mentions;
}

std::vector<Row> rows_of(std::string_view markdown) {
    std::vector<Row> rows;
    for (const std::string_view line : lines_of(markdown))
        if (line.starts_with('|') && !line.starts_with("|--"))
            rows.push_back(cells_of(line));
    return rows;
}

std::vector<std::string> example_lines(std::string_view markdown) {
    std::vector<std::string> examples;
    bool in_shell = false, goes_on = false;
    for (const std::string_view line : lines_of(markdown)) {
        if (line.starts_with("```")) {
            in_shell = line == "```sh";
        } else if (in_shell && goes_on) {
            examples.back().append("\n").append(line);
        } else if (in_shell) {
            examples.emplace_back(line);
        }
        goes_on = in_shell && line.ends_with('\\');
    }
    return examples;
}

} // namespace tidemark::cli
