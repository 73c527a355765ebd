#include "cli/commands.hpp"
#include "cli/console.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tidemark::cli {
namespace {

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

/// A branch of the script for the command and before it one for each of its own sub-commands, whose options
/// are known once it is written.
std::string branches_of(const CLI::App& command) {
    constexpr auto branch = "        {}) words='{}' ;;\n";
    const std::string& name = command.get_name();
    std::vector<std::string> words = option_names(command);
    std::string branches;
    for (const CLI::App* inner : command.get_subcommands({})) {
        words.push_back(inner->get_name());
        branches += fmt::format(branch, fmt::format("'{} {}'", name, inner->get_name()),
                                fmt::join(option_names(*inner), " "));
    }
    return branches + fmt::format(branch, fmt::format("{0}|'{0} '*", name), fmt::join(words, " "));
}

/// A bash function over the very options that the program parses. Whatever is no option is a file.
std::string bash_script(const CLI::App& app) {
    std::vector<std::string> commands;
    std::string cases;
    for (const CLI::App* command : app.get_subcommands({})) {
        commands.push_back(command->get_name());
        cases += branches_of(*command);
    }
    return fmt::format(R"(# Completion of tidemark for bash: source <(tidemark completion)
_tidemark() {{
    local words='{} {}' current="${{COMP_WORDS[COMP_CWORD]}}"
    if [ "$COMP_CWORD" -gt 1 ]; then
        local before="${{COMP_WORDS[1]}}"
        [ "$COMP_CWORD" -gt 2 ] && before="$before ${{COMP_WORDS[2]}}"
        case "$before" in
{}        *) words='' ;;
        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$current") $(compgen -f -- "$current"))
}}
complete -o filenames -F _tidemark tidemark
)",
                       fmt::join(commands, " "), fmt::join(option_names(app), " "), cases);
}

} // namespace

void add_completion(CLI::App& app, Action& chosen) {
    CLI::App* command = app.add_subcommand("completion", "Prints the completion script for bash");
    command->callback(
        [&app, &chosen] { chosen = [&app] { return put(bash_script(app)).map([] { return 0; }); }; });
}

} // namespace tidemark::cli
