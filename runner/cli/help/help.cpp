#include "base/file.hpp"
#include "base/try.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/help/man_page.hpp"
#include "cli/help/pages.hpp"
#include "cli/help/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tidemark::cli {
namespace {

std::string list_of(const std::vector<Topic>& topics) {
    std::string list =
        "tidemark help TOPIC prints a page, or one of the sections that stand below it here.\n";
    for (const Topic& topic : topics)
        list += (topic.whole_page ? "\n" : "  ") + topic.name + '\n';
    return list;
}

Result<int> help(const std::string& name) {
    const std::vector<Topic> topics = topics_of(help_pages());
    if (name.empty())
        return put(list_of(topics)).map([] { return 0; });
    const auto topic =
        std::find_if(topics.begin(), topics.end(), [&](const Topic& t) { return t.name == name; });
    if (topic != topics.end())
        return put(plain_text(topic->markdown)).map([] { return 0; });
    const std::string nearest = nearest_name(name, help_topics());
    return fail(ErrorCode::usage, fmt::format("no topic '{}': {}", name,
                                              nearest.empty() ? "`tidemark help` lists them"
                                                              : fmt::format("did you mean '{}'?", nearest)));
}

/// Writes one page for each command, and one for the program.
Result<int> write_man_pages(Command program, const std::filesystem::path& folder) {
    TRY(make_folder(folder));
    std::vector<Command> all = program.subcommands();
    all.push_back(program);
    for (const Command& command : all) {
        const ManPage page = man_page(command.app());
        TRY(write_file(folder / (page.name + ".1"), page.roff));
    }
    return 0;
}

} // namespace

std::vector<std::string> help_topics() {
    std::vector<std::string> names;
    for (const Topic& topic : topics_of(help_pages()))
        if (std::ranges::find(names, topic.name) == names.end())
            names.push_back(topic.name);
    return names;
}

void add_help(Command app, Action& chosen) {
    auto topic = std::make_shared<std::string>();
    Command command = app.add_subcommand("help", "Prints a section of the manual, or the list of them");
    command.add_option("TOPIC", *topic, "A section, as in keys, recordings, directives, check");
    auto folder = std::make_shared<std::string>();
    command.add_option("--man", *folder, "Writes a page for man(1) on every command into that folder")
        .type_name("FOLDER");
    command.on_call([topic, folder, app, &chosen] {
        chosen = [topic, folder, app] {
            return folder->empty() ? help(*topic) : write_man_pages(app, *folder);
        };
    });
}

} // namespace tidemark::cli
