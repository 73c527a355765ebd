// Makes pages for man(1) from the options that the program parses. Writes no files.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tidemark::cli {

struct ManPage {
    std::string name; ///< for example "tidemark-capture"
    std::string roff;
};

/// Returns the page of the program or of one of its commands, including its sub-commands.
ManPage man_page(const CLI::App& command);

} // namespace tidemark::cli
