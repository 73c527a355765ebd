// The options of `view` that place its windows.
#pragma once

#include "base/result.hpp"
#include "cli/command_line.hpp"
#include "platform/window.hpp"

#include <optional>
#include <string>

namespace tidemark::cli {

/// The options as typed.
struct WindowOptions {
    bool on_top = false;
    std::optional<int> monitor;
    std::optional<std::string> position;
    bool output = false;
    std::optional<int> output_monitor;
};

/// Adds --on-top, --monitor, --position, --output-window and --output-monitor.
void add_window_options(Command command, WindowOptions& options);

/// Returns the placement of the first window.
Result<platform::WindowWishes> resolve(const WindowOptions& options);

} // namespace tidemark::cli
