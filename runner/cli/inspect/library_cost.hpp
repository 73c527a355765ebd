// What loading a library costs that a scene without such inputs does not load.
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

    /// In this process.
    bool is_loaded() const;
};

std::span<const OptionalLibrary> optional_libraries();

struct LibraryCost {
    lab::Elapsed time; ///< medians
    double mebibytes = 0;
};

/// In processes of their own: a library is loaded once. To be called before there is an OpenGL context.
/// Once at least, and again as long as `seconds` last.
Result<LibraryCost> measure_loading(const OptionalLibrary& library, double seconds);

} // namespace tidemark::cli
