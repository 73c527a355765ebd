// Measures what it costs to load a library that a scene without such inputs does not load.
#pragma once

#include "base/result.hpp"
#include "lab/stopwatch.hpp"

#include <span>
#include <string_view>

namespace tidemark::cli {

struct OptionalLibrary {
    std::string_view name;
    std::string_view file; ///< part of the name of its shared object
    void (*load)();

    /// Returns true if it is loaded in this process.
    bool is_loaded() const;
};

std::span<const OptionalLibrary> optional_libraries();

struct LibraryCost {
    lab::Elapsed time; ///< medians
    double mebibytes = 0;
};

/// Loads the library in child processes, since a process loads it only once: at least once, and repeatedly
/// for up to `seconds`. Call it before there is an OpenGL context.
Result<LibraryCost> measure_loading(const OptionalLibrary& library, double seconds);

} // namespace tidemark::cli
