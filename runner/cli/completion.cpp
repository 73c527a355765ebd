// Completes the last argument of a command line: commands, options, and known values. Prints nothing.

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/gl_context.hpp"
#include "lab/probes.hpp"
#include "scene/load_scene.hpp"
#include "shader/definitions.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace {

using Words = std::vector<std::string>;

/// Returns the innermost command named in `before`.
const CLI::App& command_of(const CLI::App& app, const Words& before) {
    const CLI::App* command = &app;
    for (const std::string& word : before)
        for (const CLI::App* inner : command->get_subcommands({}))
            if (inner->get_name() == word) {
                command = inner;
                break;
            }
    if (command == &app && !before.empty() && !before.front().starts_with('-'))
        return *app.get_subcommand("view"); // `tidemark SCENE` is short for `tidemark view SCENE`
    return *command;
}

Words commands_and_options(const CLI::App& command) {
    Words names;
    for (const CLI::App* inner : command.get_subcommands({}))
        names.push_back(inner->get_name());
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty())
            continue;
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

/// Returns the knobs, or the names for --define, of the first argument that is a scene.
Words names_in_scene(const Words& before, bool knobs) {
    Words names;
    for (const std::string& word : before) {
        std::error_code ignored;
        if (!std::filesystem::exists(word, ignored))
            continue;
        const auto scene = scene::load_scene(word);
        if (!scene)
            continue;
        if (knobs)
            for (const scene::Knob& knob : scene->knobs)
                names.push_back(knob.name + "=");
        else
            for (const glsl::NamedText& definition : glsl::definitions_of(*scene))
                names.push_back(definition.name + "=");
        break;
    }
    return names;
}

Words names_of_probes() {
    Words names;
    for (const lab::Probe& probe : lab::all_probes())
        names.emplace_back(probe.name);
    return names;
}

/// Splits choices such as `single|double`; returns nothing for other forms, such as
/// `[PASS:]N=FILE|noise|none`.
Words choices(const std::string& type) {
    const bool plain = std::all_of(type.begin(), type.end(), [](unsigned char c) {
        return c == '|' || std::islower(c) || std::isdigit(c);
    });
    return plain && type.find('|') != type.npos ? CLI::detail::split(type, '|') : Words{};
}

Words values_of(const CLI::Option& option, const Words& before) {
    if (option.check_lname("set") || option.check_lname("define"))
        return names_in_scene(before, option.check_lname("set"));
    if (option.check_lname("probe"))
        return names_of_probes();
    if (option.check_lname("device"))
        return host::device_names();
    return choices(option.get_type_name());
}

/// Returns what starts with the last of `words`, which may be empty; the arguments before it determine the
/// command, the option and the scene. The shell completes file names itself.
Words candidates(const CLI::App& app, const Words& words) {
    if (words.empty())
        return {};
    const Words before(words.begin(), words.end() - 1);
    const CLI::App& command = command_of(app, before);
    const CLI::Option* option = !before.empty() && before.back().starts_with('-')
                                    ? command.get_option_no_throw(before.back())
                                    : nullptr;
    const bool wants_value = option && option->get_items_expected_max() > 0;
    Words found = wants_value ? values_of(*option, before) : commands_and_options(command);
    if (!wants_value && command.get_name() == "help")
        std::ranges::copy(help_topics(), std::back_inserter(found));
    std::erase_if(found, [&](const std::string& word) { return !word.starts_with(words.back()); });
    return found;
}

// Each script calls `tidemark completion words` for the candidates, and adds file names.

constexpr std::string_view k_bash = R"sh(# Completion of tidemark for bash: source <(tidemark completion)
_tidemark() {
    local IFS=$'\n' current="${COMP_WORDS[COMP_CWORD]}"
    COMPREPLY=($("${COMP_WORDS[0]}" completion words -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null))
    # As a file's name a word would have a backslash before its = and its colons.
    if [[ "${COMPREPLY[*]-}" == *[=:]* ]]; then
        if [[ ${COMPREPLY[0]} == *= ]]; then compopt -o nospace 2>/dev/null || true; fi
    else
        COMPREPLY+=($(compgen -f -- "$current"))
        compopt -o filenames 2>/dev/null || true
    fi
}
complete -F _tidemark tidemark
)sh";

constexpr std::string_view k_zsh = R"sh(#compdef tidemark
# Completion of tidemark for zsh: source <(tidemark completion zsh)
_tidemark() {
    local -a found
    found=(${(f)"$($words[1] completion words -- "${(@)words[2,CURRENT]}" 2>/dev/null)"})
    compadd -S '' -- ${(M)found:#*=}
    compadd -- ${found:#*=}
    _files
}
if [[ $funcstack[1] == _tidemark ]]; then _tidemark "$@"; else compdef _tidemark tidemark; fi
)sh";

constexpr std::string_view k_fish = R"sh(# Completion of tidemark for fish: tidemark completion fish | source
function __tidemark_words
    set -l words (commandline -opc) (commandline -ct)
    $words[1] completion words -- $words[2..-1] 2>/dev/null
end
complete -c tidemark -a '(__tidemark_words)'
)sh";

Result<int> print_completion(Command app, const std::string& what, const std::vector<std::string>& words) {
    if (what != "words" && !words.empty())
        return fail(ErrorCode::usage, "unexpected argument '" + words.front() + "'");
    std::string text;
    if (what == "words")
        for (const std::string& word : candidates(app.app(), words))
            text += word + '\n';
    else
        text = what == "zsh" ? k_zsh : what == "fish" ? k_fish : k_bash;
    TRY(put(text));
    return 0;
}

} // namespace

void add_completion(Command app, Action& chosen) {
    struct Options {
        std::string what = "bash";
        std::vector<std::string> words;
    };
    auto options = std::make_shared<Options>();
    Command command = app.add_subcommand("completion", "Prints the completion script for bash, zsh or fish");
    command
        .add_option("SHELL", options->what,
                    "bash, zsh or fish; words: the possible completions of the last WORD")
        .type_name("bash|zsh|fish|words")
        .check(one_of({"bash", "zsh", "fish", "words"}));
    command.add_option("WORD", options->words, "With words: the command line typed so far, after --")
        .take_all();
    command.on_call([options, app, &chosen] {
        chosen = [options, app] { return print_completion(app, options->what, options->words); };
    });
}

} // namespace tidemark::cli
