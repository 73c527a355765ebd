// The manual: finds sections of its Markdown pages by name, and formats them for a terminal.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// A page or one of its sections. Views into the page's text.
struct Topic {
    std::string name;          ///< its title in lower case, for example "exit-codes"
    std::string_view markdown; ///< includes the heading
    bool whole_page = false;
};

/// Returns every page and its sections, in the order of the pages.
std::vector<Topic> topics_of(std::span<const std::string_view> pages);

/// A section that contains a word, and the first line that does.
struct Mention {
    std::string topic;
    std::string line; ///< plain text, at most 100 bytes
};

/// Returns the sections that contain `word` in any case, those with the most occurrences first; at most 10.
std::vector<Mention> mentions_of(std::string_view word, const std::vector<Topic>& topics);

/// Removes pictures, comments and link targets. Tables are set in columns, or, if these are wide, with the
/// cells of a row below each other.
std::string plain_text(std::string_view markdown);

/// Returns the cells of all tables, row by row, including headings, without link targets.
std::vector<std::vector<std::string>> rows_of(std::string_view markdown);

/// Returns the lines of the shell examples, each with the comment after it; a line with its continuation
/// lines is one element.
std::vector<std::string> example_lines(std::string_view markdown);

/// Returns the Markdown of each manual page, the command line's first. They are embedded when the program is
/// built (runner/CMakeLists.txt).
std::span<const std::string_view> help_pages();

} // namespace tidemark::cli
