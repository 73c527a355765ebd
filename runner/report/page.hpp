// A report page: one HTML file that makes no network requests and is complete without scripts. Texts and the
// body's HTML in, the file's text out, with the style and the scripts of page/.
#pragma once

#include <string>

namespace tidemark::report {

struct Page {
    std::string title; ///< plain text, as the next two fields are
    std::string heading;
    std::string about;
    std::string body;   ///< HTML
    std::string data{}; ///< JSON for the scripts of a diagram; empty: no diagram
};

std::string make_page(const Page& page);

/// Returns a command with a button that copies it, if scripts are on.
std::string command(const std::string& words);

/// Returns a table with its own scroll bar. `name` is its accessible name; `rows` is HTML.
std::string table(const std::string& name, const std::string& rows);

} // namespace tidemark::report
