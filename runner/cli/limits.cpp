#include "cli/limits.hpp"

#include "cli/command_line.hpp"
#include "cli/memory_limit.hpp"

namespace tidemark::cli {

bool compiles_scenes(Command command) {
    return command.has_option("SCENE") && command.has_option("--set");
}

void add_memory_option(Command command, LimitOptions& options) {
    command.add_option("--memory", options.memory, "What compiling and drawing may take, as in 2G [50%]")
        .type_name("SIZE");
}

void add_limit_options(Command app, LimitOptions& options) {
    for (Command command : app.subcommands()) {
        if (!compiles_scenes(command) || command.has_option("--memory")) // `view` adds its own
            continue;
        add_memory_option(command, options);
        if (!command.has_option("--timeout"))
            command
                .add_option("--timeout", options.timeout,
                            "Give up where the driver takes longer to compile a pass or to draw")
                .type_name("SECONDS")
                .check(number<double>("a number of seconds"));
    }
}

Result<Limits> resolve(const LimitOptions& options) {
    if (options.timeout && !(*options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    const uint64_t machine = machine_memory();
    if (!options.memory)
        return Limits{machine / 2, options.timeout};
    return parse_memory(*options.memory, machine).map([&](uint64_t bytes) {
        return Limits{bytes, options.timeout};
    });
}

} // namespace tidemark::cli
