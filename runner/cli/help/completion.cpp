#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help/candidates.hpp"

#include <memory>

namespace tidemark::cli {
namespace {

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
    command.add_option("SHELL", options->what, "bash, zsh or fish; words: what the last WORD may become")
        .type_name("bash|zsh|fish|words")
        .check(one_of({"bash", "zsh", "fish", "words"}));
    command.add_option("WORD", options->words, "With words, behind --: the line as far as it is typed")
        .take_all();
    command.on_call([options, app, &chosen] {
        chosen = [options, app] { return print_completion(app, options->what, options->words); };
    });
}

} // namespace tidemark::cli
