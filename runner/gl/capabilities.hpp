// What the current context is and how much it can do.
#pragma once

#include <string>
#include <vector>

namespace tidemark::gl {

struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;
    int largest_target = 0;  ///< pixels on a side
    std::string processor{}; ///< its maker, where it draws

    /// What rounds a picture: the renderer, and the processor behind one that is software.
    std::string device() const { return processor.empty() ? renderer : renderer + " on " + processor; }
};

Capabilities query_capabilities();

/// The names of its extensions, which a shader finds defined as macros.
std::vector<std::string> query_extensions();

} // namespace tidemark::gl
