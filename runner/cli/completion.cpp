#include "cli/commands.hpp"
#include "cli/console.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

/// What may follow the command: its options, its own sub-commands and theirs.
std::vector<std::string> words_after(const CLI::App& command) {
    std::vector<std::string> words = option_names(command);
    for (const CLI::App* inner : command.get_subcommands({})) {
        words.push_back(inner->get_name());
        for (const std::string& name : option_names(*inner))
            if (std::find(words.begin(), words.end(), name) == words.end())
                words.push_back(name);
    }
    return words;
}

/// A bash function over the very options that the program parses. Whatever is no option is a file.
std::string bash_script(const CLI::App& app) {
    std::vector<std::string> commands;
    std::string cases;
    for (const CLI::App* command : app.get_subcommands({})) {
        commands.push_back(command->get_name());
        cases += fmt::format("        {}) words='{}' ;;\n", command->get_name(),
                             fmt::join(words_after(*command), " "));
    }
    return fmt::format(R"(# Completion of tidemark for bash: source <(tidemark completion)
_tidemark() {{
    local words='{} {}' current="${{COMP_WORDS[COMP_CWORD]}}"
    if [ "$COMP_CWORD" -gt 1 ]; then
        case "${{COMP_WORDS[1]}}" in
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
