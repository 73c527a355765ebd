// Sections of Markdown pages, by name, and their text as a terminal shows it. Prints nothing.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

/// A page, or a section of one. Views into the page.
struct Topic {
    std::string name;          ///< its title, as in "exit-codes"
    std::string_view markdown; ///< with its heading
    bool whole_page = false;
};

/// Every page and the sections of it, in the order of the pages.
std::vector<Topic> topics_of(std::span<const std::string_view> pages);

/// Without pictures, comments and the targets of links; tables in columns, or, where those are wide, with the
/// cells of a row below each other.
std::string plain_text(std::string_view markdown);

/// The cells of its tables, row by row, headings too, without the targets of links.
std::vector<std::vector<std::string>> rows_of(std::string_view markdown);

/// Lines of its shell examples, each with the comment behind it; what goes on in a second line is one.
std::vector<std::string> example_lines(std::string_view markdown);

} // namespace tidemark::cli
