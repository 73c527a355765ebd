// The options that bound what a command may take, and what they come to.
#pragma once

#include "base/result.hpp"
#include "cli/command_line.hpp"
#include "cli/supervisor.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

struct LimitOptions {
    std::optional<std::string> memory;
    std::optional<double> timeout;
};

/// Whether a sub-command has a driver compile or draw a scene.
bool compiles_scenes(Command command);

void add_memory_option(Command command, LimitOptions& options);

/// --memory for every sub-command that has a driver draw and has none of its own; --timeout likewise.
void add_limit_options(Command app, LimitOptions& options);

/// Without --memory: half of the machine's.
Result<Limits> resolve(const LimitOptions& options);

} // namespace tidemark::cli
