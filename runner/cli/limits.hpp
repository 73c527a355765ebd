// The options that limit memory and time of a command, and the limits that result.
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

/// Returns true if a sub-command compiles or draws a scene.
bool compiles_scenes(Command command);

void add_memory_option(Command command, LimitOptions& options);

/// Adds --memory and --timeout to every sub-command that compiles scenes and does not have its own.
void add_limit_options(Command app, LimitOptions& options);

/// Returns the limits; without --memory, half of the machine's memory.
Result<Limits> resolve(const LimitOptions& options);

} // namespace tidemark::cli
