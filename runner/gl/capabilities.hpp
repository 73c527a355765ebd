// Reads the names and limits of the current context.
#pragma once

#include <string>
#include <vector>

namespace tidemark::gl {

struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;
    int largest_target = 0;  ///< pixels on a side
    std::string processor{}; ///< CPU vendor, for a software renderer; else empty

    /// Returns what determines rounding: the renderer and, for a software renderer, the CPU vendor.
    std::string device() const { return processor.empty() ? renderer : renderer + " on " + processor; }
};

Capabilities query_capabilities();

/// Returns the names of the extensions, each of which a shader sees as a macro.
std::vector<std::string> query_extensions();

} // namespace tidemark::gl
