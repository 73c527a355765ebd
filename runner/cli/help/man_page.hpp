// Pages for man(1) from the options that the program parses. Writes nothing.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tidemark::cli {

struct ManPage {
    std::string name; ///< "tidemark-capture"
    std::string roff;
};

/// The page of the program or of one of its commands, whose own sub-commands stand in it.
ManPage man_page(const CLI::App& command);

} // namespace tidemark::cli
