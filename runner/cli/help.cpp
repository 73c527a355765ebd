#include "cli/help.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/tokens.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace {

/// Tables are set in columns if all but the last are at most this wide together.
constexpr size_t k_widest_columns = 40;

constexpr std::string_view k_section = "\n## ";

std::string name_of(std::string_view title) {
    std::string name;
    for (const char c : title) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += char(std::tolower(static_cast<unsigned char>(c)));
        else if (c == ' ')
            name += '-';
    }
    return name;
}

/// Returns the topic of a text that begins with its heading.
Topic topic_of(std::string_view markdown, bool whole_page) {
    const std::string_view heading = markdown.substr(0, markdown.find('\n'));
    const std::string_view title = heading.substr(heading.find(' ') + 1);
    return {name_of(title), markdown, whole_page};
}

/// Counts code points; each is one column in the characters that the pages use.
size_t width_of(std::string_view text) {
    return size_t(std::ranges::count_if(text, std::not_fn(continues_character)));
}

/// Replaces `[text](target)` and `**text**` by the text.
std::string without_marks(std::string_view line) {
    std::string text;
    while (!line.empty()) {
        const size_t middle = line.find("](");
        const size_t end = line.find(')', middle == line.npos ? line.size() : middle);
        if (line.starts_with("**")) {
            line.remove_prefix(2);
        } else if (line.front() == '[' && end != line.npos && line.find(']') == middle) {
            text += line.substr(1, middle - 1);
            line.remove_prefix(end + 1);
        } else {
            text += line.front();
            line.remove_prefix(1);
        }
    }
    return text;
}

using Row = std::vector<std::string>;

/// Splits `| a | b |` into cells; `\|` is part of a cell.
Row cells_of(std::string_view line) {
    Row cells;
    std::string cell;
    for (size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
            cell += line[++i];
        } else if (line[i] == '|') {
            cells.push_back(cell.size() > 2 ? without_marks(cell.substr(1, cell.size() - 2)) : "");
            cell.clear();
        } else {
            cell += line[i];
        }
    }
    return cells;
}

std::string table_text(const std::vector<Row>& rows) {
    std::vector<size_t> widths(rows.front().size(), 0);
    for (const Row& row : rows)
        for (size_t i = 0; i + 1 < std::min(row.size(), widths.size()); ++i)
            widths[i] = std::max(widths[i], width_of(row[i]) + 2);
    const bool in_columns = std::accumulate(widths.begin(), widths.end(), size_t(0)) <= k_widest_columns;
    std::string text;
    for (const Row& row : rows) {
        for (size_t i = 0; i < row.size(); ++i) {
            if (!in_columns)
                text += i == 0 ? "  " + row[i] : "\n      " + row[i];
            else if (i + 1 < row.size())
                text += (i == 0 ? "  " : "") + row[i] + std::string(widths[i] - width_of(row[i]), ' ');
            else
                text += row[i];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    return text;
}

/// Converts a text line by line; the rows of a table are kept until it ends.
class PlainText {
public:
    void add(std::string_view line) {
        if (line.starts_with("```")) {
            in_code_ = !in_code_;
        } else if (in_code_) {
            text_.append("    ").append(line) += '\n';
        } else if (line.starts_with("<!--") || line.starts_with("|--") || line.find("![") != line.npos ||
                   line.find("<img") != line.npos) {
            return;
        } else if (line.starts_with('|')) {
            rows_.push_back(cells_of(line));
        } else {
            end_table();
            const size_t marks = line.starts_with('#') ? line.find(' ') + 1 : 0;
            text_ += without_marks(line.substr(marks)) + '\n';
        }
    }

    std::string finish() && {
        end_table();
        return std::move(text_);
    }

private:
    void end_table() {
        if (!rows_.empty())
            text_ += table_text(rows_);
        rows_.clear();
    }

    std::string text_;
    std::vector<Row> rows_;
    bool in_code_ = false;
};

} // namespace

std::vector<Topic> topics_of(std::span<const std::string_view> pages) {
    std::vector<Topic> topics;
    for (const std::string_view page : pages) {
        topics.push_back(topic_of(page, true));
        for (size_t at = page.find(k_section); at != page.npos;) {
            const size_t next = page.find(k_section, at + 1);
            topics.push_back(topic_of(page.substr(at + 1, next - at - 1), false));
            at = next;
        }
    }
    return topics;
}

std::string plain_text(std::string_view markdown) {
    PlainText plain;
    for (const std::string_view line : text::lines_of(markdown))
        plain.add(line);
    return std::move(plain).finish();
}

std::vector<Mention> mentions_of(std::string_view word, const std::vector<Topic>& topics) {
    constexpr size_t k_most = 10, k_longest_line = 100;
    const std::string wanted = lower_case(std::string(word));
    std::vector<std::pair<size_t, Mention>> counted;
    for (const Topic& topic : topics) {
        if (topic.whole_page && topic.markdown.find(k_section) != topic.markdown.npos)
            continue; // its sections are found by themselves
        size_t count = 0;
        std::string first;
        const std::string text = plain_text(topic.markdown);
        for (const std::string_view line : text::lines_of(text))
            if (lower_case(std::string(line)).find(wanted) != std::string::npos && count++ == 0)
                first = line.substr(std::min(line.find_first_not_of(' '), line.size()));
        if (count > 0)
            counted.push_back({count, {topic.name, cut_text(first, k_longest_line)}});
    }
    std::ranges::stable_sort(counted, std::ranges::greater(), &std::pair<size_t, Mention>::first);
    std::vector<Mention> mentions;
    for (auto& [count, mention] : counted)
        if (mentions.size() < k_most)
            mentions.push_back(std::move(mention));
    return mentions;
}

std::vector<Row> rows_of(std::string_view markdown) {
    std::vector<Row> rows;
    for (const std::string_view line : text::lines_of(markdown))
        if (line.starts_with('|') && !line.starts_with("|--"))
            rows.push_back(cells_of(line));
    return rows;
}

std::vector<std::string> example_lines(std::string_view markdown) {
    std::vector<std::string> examples;
    bool in_shell = false, goes_on = false;
    for (const std::string_view line : text::lines_of(markdown)) {
        if (line.starts_with("```")) {
            in_shell = line == "```sh";
        } else if (in_shell && goes_on) {
            examples.back().append("\n").append(line);
        } else if (in_shell) {
            examples.emplace_back(line);
        }
        goes_on = in_shell && line.ends_with('\\');
    }
    return examples;
}

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
    const CLI::Formatter words;
    std::string roff;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group().empty())
            continue;
        const bool positional = option->get_positional() && !option->nonpositional();
        roff += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(words.make_option_name(option, positional)),
                            plain(value_words(*option)), plain(words.make_option_desc(option)));
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
