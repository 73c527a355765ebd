#include "base/supervision.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/devices.hpp"
#include "host/diagnostics.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <optional>
#include <sstream>

namespace tidemark::cli {

using namespace host;
using host::resolve;
namespace {

constexpr AddCommand k_commands[] = {
#ifdef TIDEMARK_WINDOW
    add_view,
#endif
    add_new,    add_serve,   add_capture, add_gather,     add_inspect,  add_check,
    add_trace,  add_compare, add_study,   add_tune,       add_simplify, add_import,
    add_export, add_bake,    add_lsp,     add_completion, add_help,
};

constexpr const char* k_footer =
    R"(`tidemark SCENE` is short for `tidemark view SCENE`. `tidemark COMMAND --help` lists the options,
`tidemark help` the sections of the manual.
Exit codes: 0 ok, 1 a check failed, 2 usage, 3 scene does not load or compile, 4 output cannot be written or
memory ran out, 5 timed out or more memory than --memory, 70 internal error, 77 no OpenGL context, 130 interrupted.)";

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

/// Inserts `view` before a first argument that is a scene, so that `tidemark SCENE …` means `tidemark view
/// SCENE …`. Fails (ErrorCode::usage) if it is neither a command nor a scene.
Result<void> supply_view(const CLI::App& app, std::vector<std::string>& arguments) {
    if (arguments.empty() || arguments[0].starts_with('-'))
        return {};
    const std::vector<std::string> names = command_names(app);
    if (std::find(names.begin(), names.end(), arguments[0]) != names.end())
        return {};
    std::error_code ignored;
    const std::string nearest = nearest_name(arguments[0], names);
    if (!std::filesystem::exists(arguments[0], ignored)) {
        if (!nearest.empty())
            return fail(ErrorCode::usage,
                        fmt::format("unknown command '{}': did you mean '{}'?", arguments[0], nearest));
        if (arguments[0].find_first_of("./") == std::string::npos)
            return fail(
                ErrorCode::usage,
                fmt::format("'{}' is neither a command nor a scene; `tidemark --help` lists the commands",
                            arguments[0]));
    }
    arguments.insert(arguments.begin(), "view");
    return {};
}

/// Returns the innermost sub-command on the command line.
const CLI::App& called(const CLI::App& app) {
    const auto inner = app.get_subcommands();
    return inner.empty() ? app : called(*inner.front());
}

/// Returns the full command name as typed, for example `tidemark bake noise`.
std::string words_to(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return parent ? words_to(*parent) + " " + command.get_name() : command.get_name();
}

Error unexpected(const CLI::App& app, const std::string& argument) {
    const CLI::App& command = called(app);
    if (!argument.starts_with('-'))
        return {ErrorCode::usage, fmt::format("unexpected argument '{}'", argument), {}};
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    const std::string bare = argument.substr(0, argument.find('='));
    const std::string nearest = nearest_name(bare, names);
    const std::string hint = nearest.empty() ? fmt::format("`{} --help` lists the options", words_to(command))
                                             : fmt::format("did you mean {}?", nearest);
    return {ErrorCode::usage, fmt::format("unknown option {}: {}", bare, hint), {}};
}

/// Returns the error for a required argument that is missing. CLI11's message covers options; a missing
/// sub-command gets one of ours.
Error missing(const CLI::App& app, const CLI::RequiredError& error) {
    const CLI::App& command = called(app);
    const auto say_what = [&](std::string_view what) {
        return Error{ErrorCode::usage, fmt::format("{}: {}", command.get_name(), what), {}};
    };
    const std::vector<std::string> names = command_names(command);
    if (names.empty())
        return say_what(error.what());
    const auto extra = command.remaining(true);
    const std::string choice = fmt::format("give {}", fmt::join(names, " or "));
    if (extra.empty())
        return say_what(choice);
    if (extra.front().starts_with('-'))
        return unexpected(app, extra.front());
    return say_what(fmt::format("unknown '{}': {}", extra.front(), choice));
}

/// Returns the error for an option without its value: CLI11's message gives the option's name and nothing
/// else of use.
Error without_value(const CLI::App& app, const CLI::ArgumentMismatch& error) {
    const std::string words = error.what();
    const std::string name = words.substr(0, words.find(':'));
    const CLI::Option* option = called(app).get_option_no_throw(name);
    return {ErrorCode::usage,
            option ? fmt::format("{}: give a value, {}", name, option->get_type_name()) : words,
            {}};
}

int report(const Error& error) {
    say(error);
    return exit_code(error.code);
}

/// Parses the arguments and converts CLI11's exceptions to messages. Returns the exit code when the program
/// is to end, or nothing when it is to go on.
std::optional<int> parse(CLI::App& app, std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end()); // CLI11 takes arguments from the back
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::Success& asked) { // --help, --version
        std::ostringstream text;
        app.exit(asked, text, text);
        const auto printed = put(text.str());
        return printed ? 0 : report(printed.error());
    } catch (const CLI::ExtrasError&) {
        const auto extra = app.remaining(true);
        return report(unexpected(app, extra.empty() ? "" : extra.front()));
    } catch (const CLI::RequiredError& error) {
        return report(missing(app, error));
    } catch (const CLI::ArgumentMismatch& error) {
        return report(without_value(app, error));
    } catch (const CLI::ConversionError& error) { // "Could not convert: --option = value"
        const std::string_view words = error.what();
        return report(
            {ErrorCode::usage,
             fmt::format("{}: not a number", words.substr(std::min(words.find("--"), words.size()))),
             {}});
    } catch (const CLI::Error& error) {
        return report({ErrorCode::usage, error.what(), {}});
    }
    return std::nullopt;
}

int run_or_throw(int argc, const char* const* argv) {
    std::signal(SIGPIPE, SIG_IGN); // a reader that closed the pipe is a write error like any other
    std::signal(SIGXFSZ, SIG_IGN); // so is a file-size limit
    clear_leftovers_on_signals();

    CLI::App app(
        "Tidemark runs ShaderToy shaders: live in a window, or into deterministic frames with no display.");
    app.name("tidemark");
    app.set_version_flag("--version", std::string("tidemark ") + k_version);
    format_help(app);
    app.footer(k_footer);
    app.require_subcommand(1);
    // An alias may add an option that the command line gives again.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    Action chosen;
    for (const AddCommand add : k_commands)
        add(Command(app), chosen);
    LimitOptions limits;
    add_limit_options(Command(app), limits);
    add_diagnostics_option(Command(app));

    std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty())
        arguments.emplace_back("--help");
    if (auto supplied = supply_view(app, arguments); !supplied)
        return report(supplied.error());
#ifndef TIDEMARK_WINDOW
    if (arguments[0] == "view")
        return report({ErrorCode::usage,
                       "this build has no window (TIDEMARK_WINDOW=OFF): `tidemark capture` draws without one",
                       {}});
#endif
    if (const auto done = parse(app, std::move(arguments)))
        return *done;
    const auto bounds = resolve(limits);
    if (!bounds)
        return report(bounds.error());
    // `view`, `serve` and `lsp` keep their own process: they test an unknown scene in a child of their own.
    if (const std::string name = called(app).get_name(); name != "view" && name != "serve" && name != "lsp")
        if (const auto ended = supervise(*bounds)) {
            finish_diagnostics(false); // errors about how the child ended; the child wrote its own
            return *ended;
        }
    host::do_without_full_driver_cache();
    const auto outcome = chosen();
    const int code = outcome ? *outcome : report(outcome.error());
    finish_diagnostics(true);
    return code;
}

/// Raises the stack limit to 8 MiB if it is lower; the kernel reads the limit each time the stack grows.
/// Returns false if less than 1 MiB is allowed, which is too little for a driver's compiler or for libraries.
bool make_room_on_the_stack() {
    constexpr rlim_t k_usual = rlim_t{8} << 20, k_least = rlim_t{1} << 20;
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) != 0 ||
        limit.rlim_cur >= k_usual) // RLIM_INFINITY is the largest number
        return true;
    limit.rlim_cur = std::min(k_usual, limit.rlim_max);
    ::setrlimit(RLIMIT_STACK, &limit);
    ::getrlimit(RLIMIT_STACK, &limit);
    return limit.rlim_cur >= k_least;
}

/// Opens /dev/null for each standard descriptor that the caller has closed: otherwise the next file that a
/// library opens (for example Mesa's cache) would get that number and be written to as standard output.
/// Writing to this one fails.
void occupy_standard_descriptors() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0)
            (void)::open("/dev/null", O_RDONLY); // takes the lowest free number
}

} // namespace

int run(int argc, const char* const* argv) {
    occupy_standard_descriptors();
    end_by_last_resort();
    if (!make_room_on_the_stack())
        return report({ErrorCode::no_memory,
                       "the stack is limited to less than 1 MiB: allow 8 MiB (ulimit -s 8192)",
                       {}});
    try {
        return run_or_throw(argc, argv);
    } catch (...) {
        return last_resort();
    }
}

} // namespace tidemark::cli
