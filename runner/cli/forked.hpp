// Work in a process of its own, for what may crash or never end: a driver that compiles a hostile shader. To
// be called before the program has an OpenGL context or threads.
#pragma once

#include "base/result.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace tidemark::cli {

struct ForkedResult {
    std::string output;     ///< all that the work told, whole lines only
    bool timed_out = false; ///< it was ended after `seconds`
    int signal = 0;         ///< that ended it otherwise; 0: it came to its end
};

/// Tells one line to the parent; what was told survives the end of the work.
using Tell = std::function<void(std::string_view line)>;

/// Runs `work` in a child and waits for it.
Result<ForkedResult> run_forked(const std::function<void(const Tell&)>& work, double seconds);

} // namespace tidemark::cli
