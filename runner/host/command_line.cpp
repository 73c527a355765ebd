#include "host/command_line.hpp"

#include <CLI/CLI.hpp>

#include <cassert>
#include <filesystem>
#include <optional>
#include <utility>

namespace tidemark::host {
namespace {

/// Wraps a CLI11 validator without its name, which the help would print.
ValueCheck check_of(const CLI::Validator& validator) {
    return [validator](const std::string& text) { return validator(text); };
}

class HelpFormatter : public CLI::Formatter {
public:
    std::string make_option_opts(const CLI::Option* option) const override { return value_words(*option); }
};

} // namespace

void format_help(CLI::App& app) {
    app.formatter(std::make_shared<HelpFormatter>());
}

std::string value_words(const CLI::Option& option) {
    std::string text;
    if (option.get_type_size() != 0) {
        if (!option.get_type_name().empty())
            text += " " + option.get_type_name();
        if (!option.get_default_str().empty())
            text += "=" + option.get_default_str();
        if (option.get_expected_max() == CLI::detail::expected_max_vector_size)
            text += " ...";
        else if (option.get_expected_min() > 1)
            text += " x " + std::to_string(option.get_expected());
        if (option.get_required())
            text += " REQUIRED";
    }
    for (const auto& [heading, others] :
         {std::pair{" Needs:", option.get_needs()}, std::pair{" Excludes:", option.get_excludes()}}) {
        if (!others.empty())
            text += heading;
        for (const CLI::Option* other : others)
            text += " " + other->get_name();
    }
    return text;
}

ValueCheck one_of(std::vector<std::string> words) {
    return [words = std::move(words)](const std::string& text) {
        return std::ranges::find(words, text) != words.end()
                   ? std::string()
                   : fmt::format("give {}, not '{}'", fmt::join(words, " or "), text);
    };
}

ValueCheck existing_folder() {
    return check_of(CLI::ExistingDirectory);
}
ValueCheck existing_file() {
    return check_of(CLI::ExistingFile);
}
ValueCheck positive_number() {
    return check_of(CLI::PositiveNumber);
}
ValueCheck non_negative_number() {
    return check_of(CLI::NonNegativeNumber);
}

Option Option::type_name(const std::string& name) const {
    return Option(option_->type_name(name));
}
Option Option::default_str(const std::string& text) const {
    return Option(option_->default_str(text));
}
Option Option::description(const std::string& text) const {
    return Option(option_->description(text));
}
Option Option::capture_default_str() const {
    return Option(option_->capture_default_str());
}
Option Option::check(const ValueCheck& check) const {
    return Option(
        option_->check(CLI::Validator([check](std::string& text) { return check(text); }, std::string())));
}
Option Option::required(bool required) const {
    return Option(option_->required(required));
}
Option Option::needs(Option other) const {
    return Option(option_->needs(other.option_));
}
Option Option::needs(const std::string& other) const {
    return Option(option_->needs(other));
}
Option Option::excludes(Option other) const {
    return Option(option_->excludes(other.option_));
}
Option Option::excludes(const std::string& other) const {
    return Option(option_->excludes(other));
}
Option Option::group(const std::string& heading) const {
    return Option(option_->group(heading));
}
Option Option::delimiter(char separator) const {
    return Option(option_->delimiter(separator));
}
Option Option::take_all() const {
    return Option(option_->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}
Option Option::one_word() const {
    return Option(option_->allow_extra_args(false));
}
Option Option::repeatable() const {
    // `allow_extra_args` must come last: the calls before it set it again.
    return Option(option_->type_size(1)
                      ->expected(1)
                      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                      ->allow_extra_args(false));
}
Option Option::each(std::function<void(std::string)> function) const {
    return Option(option_->each(std::move(function)));
}

std::vector<std::string> Option::texts() const {
    return option_->results();
}
void Option::add_text(const std::string& text) const {
    option_->add_result(text);
}

std::string Command::name() const {
    return app_->get_name();
}
Command Command::add_subcommand(const std::string& name, const std::string& description) const {
    return Command(*app_->add_subcommand(name, description));
}

std::vector<Command> Command::subcommands() const {
    std::vector<Command> commands;
    for (CLI::App* command : app_->get_subcommands({}))
        commands.emplace_back(*command);
    return commands;
}

template <class T>
Option Command::add_option(const std::string& names, T& value, const std::string& description) const {
    return Option(app_->add_option(names, value, description));
}

template Option Command::add_option(const std::string&, int&, const std::string&) const;
template Option Command::add_option(const std::string&, unsigned&, const std::string&) const;
template Option Command::add_option(const std::string&, size_t&, const std::string&) const;
template Option Command::add_option(const std::string&, double&, const std::string&) const;
template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<int>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<std::string>&,
                                    const std::string&) const;

Option Command::add_option(const std::string& names, std::function<void(const std::string&)> function,
                           const std::string& description) const {
    return Option(app_->add_option_function<std::string>(names, function, description));
}
Option Command::add_flag(const std::string& names, bool& value, const std::string& description) const {
    return Option(app_->add_flag(names, value, description));
}
Option Command::add_flag(const std::string& names, std::function<void()> function,
                         const std::string& description) const {
    return Option(app_->add_flag_callback(names, std::move(function), description));
}

bool Command::has_option(const std::string& name) const {
    return app_->get_option_no_throw(name) != nullptr;
}
Option Command::option(const std::string& name) const {
    assert(has_option(name));
    return Option(app_->get_option(name));
}
std::vector<Option> Command::options() const {
    std::vector<Option> options;
    for (CLI::Option* option : app_->get_options())
        options.emplace_back(option);
    return options;
}

void Command::on_call(std::function<void()> function) const {
    app_->callback(std::move(function));
}
void Command::require_subcommand() const {
    app_->require_subcommand(1);
}

std::vector<std::string> Command::typed_words(std::span<const std::string_view> except) const {
    std::vector<std::string> words;
    for (const CLI::Option* option : std::as_const(*app_).get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || std::ranges::find(except, name) != except.end())
            continue;
        for (const std::string& value : option->results()) {
            if (!option->get_positional())
                words.push_back(name);
            if (option->get_items_expected_max() > 0)
                words.push_back(value);
        }
    }
    return words;
}

Result<void> parse_words(const std::function<void(Command)>& declare, std::vector<std::string> words) {
    CLI::App app;
    declare(Command(app));
    std::ranges::reverse(words); // CLI11 takes arguments from the back
    try {
        app.parse(std::move(words));
    } catch (const CLI::Success&) { // thrown by --help and --version
        return fail(ErrorCode::usage, "--help is not allowed in a file");
    } catch (const CLI::Error& error) {
        return fail(ErrorCode::usage, error.what());
    }
    return {};
}

void fail_for_missing(const std::string& name) {
    throw CLI::RequiredError(name);
}

} // namespace tidemark::host
