// What the current context is and how much it can do.
#pragma once

#include <string>
#include <vector>

namespace tidemark::gl {

struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;
    int largest_target = 0; ///< pixels on a side
};

Capabilities query_capabilities();

/// The names of its extensions, which a shader finds defined as macros.
std::vector<std::string> query_extensions();

} // namespace tidemark::gl
