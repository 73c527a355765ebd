// The options that bound what a command may take, and what they come to.
#pragma once

#include "base/result.hpp"
#include "cli/supervisor.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace tidemark::cli {

struct LimitOptions {
    std::optional<std::string> memory;
    std::optional<double> timeout;
};

/// --memory for every sub-command that has a driver draw; --timeout for those that have none of their own.
void add_limit_options(CLI::App& app, LimitOptions& options);

/// Without --memory: half of the machine's.
Result<Limits> resolve(const LimitOptions& options);

} // namespace tidemark::cli
