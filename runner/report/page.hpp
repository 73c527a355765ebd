// A page that a person opens: one file that asks no network and is whole without scripts. In: its words and
// its body as HTML. Out: the text of the file, with the style and the scripts of page/.
#pragma once

#include <string>

namespace tidemark::report {

struct Page {
    std::string title; ///< plain text, as are the next two
    std::string heading;
    std::string about;
    std::string body;   ///< HTML
    std::string data{}; ///< JSON for the scripts that explore a diagram; empty: the page has none
};

std::string make_page(const Page& page);

/// A command with the script's button that copies it.
std::string command(const std::string& words);

/// A table within its own scroll bar. `name`: what it shows, for who does not see it. `rows`: HTML.
std::string table(const std::string& name, const std::string& rows);

} // namespace tidemark::report
