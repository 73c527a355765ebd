#include "cli/view/said_once.hpp"

#include "cli/console.hpp"

namespace tidemark::cli {

void SaidOnce::say(std::string_view line) {
    line = line.substr(0, k_longest);
    if (said_.size() >= k_most_lines || !said_.emplace(line).second)
        return;
    cli::say(line);
    if (said_.size() == k_most_lines)
        cli::say("live inputs: what else is wrong with them is not said");
}

} // namespace tidemark::cli
