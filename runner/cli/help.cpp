// Makes pages for man(1) from the options that the program parses. Writes no files.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "cli/embedded_texts.hpp"
#include "cli/help_topics.hpp"
#include "host/console.hpp"
#include "host/help_formatter.hpp"
#include "host/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tidemark::cli {
namespace {

struct ManPage {
    std::string name; ///< for example "tidemark-capture"
    std::string roff;
};

/// Escapes text for roff, so that no line is a request.
std::string plain(std::string_view text) {
    std::string roff;
    for (const char c : text) {
        if ((roff.empty() || roff.back() == '\n') && (c == '.' || c == '\''))
            roff += "\\&";
        if (c == '\\')
            roff += "\\e";
        else if (c == '-')
            roff += "\\-";
        else
            roff += c;
    }
    return roff;
}

/// Returns the full command name, for example "tidemark bake noise", joined by `glue`.
std::string words_of(const CLI::App& command, std::string_view glue) {
    const CLI::App* parent = command.get_parent();
    return parent ? fmt::format("{}{}{}", words_of(*parent, glue), glue, command.get_name())
                  : command.get_name();
}

std::string synopsis(const CLI::App& command) {
    std::string line = fmt::format("\\fB{}\\fR", plain(words_of(command, " ")));
    if (!command.get_subcommands({}).empty())
        return line + " \\fICOMMAND\\fR";
    line += " [\\fIOPTION\\fR]...";
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional())
            line += fmt::format(fmt::runtime(option->get_required() ? " \\fI{}\\fR" : " [\\fI{}\\fR]"),
                                plain(option->get_name(true)));
    return line;
}

/// Lists the options as --help does: name, value, meaning.
std::string options(const CLI::App& command) {
    const HelpFormatter words;
    std::string roff;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty())
            continue;
        const bool positional = option->get_positional() && !option->nonpositional();
        roff += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(words.make_option_name(option, positional)),
                            plain(words.make_option_opts(option)), plain(words.make_option_desc(option)));
    }
    return roff;
}

std::string commands(const CLI::App& program) {
    std::string roff = ".SH COMMANDS\n";
    for (const CLI::App* command : program.get_subcommands({}))
        roff += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", plain(words_of(*command, "-")),
                            plain(command->get_description()));
    return roff;
}

std::string inner_commands(const CLI::App& command) {
    std::string roff;
    for (const CLI::App* inner : command.get_subcommands({}))
        roff += fmt::format(".SH {}\n{}\n.PP\n{}\n{}", plain(words_of(*inner, " ")),
                            plain(inner->get_description()), synopsis(*inner), options(*inner));
    return roff;
}

/// Returns a section of the manual by its name.
std::string_view section(std::string_view name) {
    for (const Topic& topic : topics_of(help_pages()))
        if (topic.name == name)
            return topic.markdown;
    return "";
}

/// Returns the section without its heading, line by line.
std::string exit_codes() {
    const std::string text = plain_text(section("exit-codes"));
    return fmt::format(".SH EXIT STATUS\n.nf\n{}.fi\n", plain(text.substr(text.find('\n') + 1)));
}

/// Returns the command's description, and each of its forms in the manual's table of commands.
std::string description(const CLI::App& command) {
    const std::string sentence = command.get_description();
    std::string roff =
        fmt::format(".SH DESCRIPTION\n{}{}\n", plain(sentence), sentence.ends_with('.') ? "" : ".");
    for (const auto& cells : rows_of(section("commands")))
        for (const std::string_view end : {" ", "`"})
            if (cells.size() > 1 && cells[0].starts_with(fmt::format("`{}{}", command.get_name(), end)))
                roff += fmt::format(".TP\n{}\n{}\n", plain(cells[0]), plain(cells[1]));
    return roff;
}

/// Lists all examples of the command in the manual.
std::string examples(const CLI::App& command) {
    std::vector<std::string> lines;
    for (const std::string_view page : help_pages())
        for (std::string& line : example_lines(page))
            if (line.starts_with(words_of(command, " ") + " ") &&
                std::find(lines.begin(), lines.end(), line) == lines.end())
                lines.push_back(std::move(line));
    return lines.empty()
               ? ""
               : fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", plain(fmt::to_string(fmt::join(lines, "\n"))));
}

/// Returns the page of the program or of one of its commands, including its sub-commands.
ManPage man_page(const CLI::App& command) {
    const bool whole = command.get_parent() == nullptr;
    const std::string name = words_of(command, "-");
    std::string roff =
        fmt::format(".TH \"{}\" 1 \"\" \"Tidemark {}\" \"User Commands\"\n", plain(name), k_version);
    roff += fmt::format(".SH NAME\n{} \\- {}\n", plain(name), plain(command.get_description()));
    roff += fmt::format(".SH SYNOPSIS\n{}\n", synopsis(command));
    if (whole) // short for `tidemark view SCENE`
        roff += fmt::format(".br\n\\fB{}\\fR \\fISCENE\\fR\n", plain(words_of(command, " ")));
    roff += description(command);
    roff += ".SH OPTIONS\n" + options(command);
    roff += whole ? commands(command) : inner_commands(command);
    roff += exit_codes();
    roff += whole ? "" : examples(command);
    roff += fmt::format(".SH SEE ALSO\n{}The whole manual: \\fBtidemark help\\fR.\n",
                        whole ? "" : "\\fBtidemark\\fR(1). ");
    return {name, std::move(roff)};
}

std::string list_of(const std::vector<Topic>& topics) {
    std::string list = "tidemark help TOPIC prints a page, or one of the sections listed below it.\n";
    for (const Topic& topic : topics)
        list += (topic.whole_page ? "\n" : "  ") + topic.name + '\n';
    return list;
}

std::string list_of(const std::vector<Mention>& mentions) {
    std::string list;
    for (const Mention& mention : mentions)
        list += fmt::format("  {}\n      {}\n", mention.topic, mention.line);
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
    if (const std::vector<Mention> mentions = mentions_of(name, topics); !mentions.empty())
        return put(fmt::format("Sections with '{}' (`tidemark help SECTION` prints one):\n{}", name,
                               list_of(mentions)))
            .map([] { return 0; });
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
    Command command = app.add_subcommand("help", "Prints a section of the manual, or lists all sections");
    command.add_option(
        "TOPIC", *topic,
        "Name of a section, as in keys, record-and-replay, directives, check; or a word to look for");
    auto folder = std::make_shared<std::string>();
    command.add_option("--man", *folder, "Writes a man page for every command into that folder")
        .type_name("FOLDER");
    command.on_call([topic, folder, app, &chosen] {
        chosen = [topic, folder, app] {
            return folder->empty() ? help(*topic) : write_man_pages(app, *folder);
        };
    });
}

} // namespace tidemark::cli
