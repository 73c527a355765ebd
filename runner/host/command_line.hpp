// The command line as the commands declare it. CLI11 parses it; only command_line.cpp, app.cpp and the pages
// made from the options (help/) include CLI11, which takes seconds to compile.
#pragma once

#include "base/encoding.hpp"
#include "base/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace tidemark::host {

/// Checks the text of a value: returns what to give instead, or an empty string if the value is valid.
using ValueCheck = std::function<std::string(const std::string&)>;

/// Accepts a number from `low` to `high`; `what` completes "give …".
template <class T>
ValueCheck number(std::string what, T low = std::numeric_limits<T>::lowest(),
                  T high = std::numeric_limits<T>::max()) {
    return [what = std::move(what), low, high](const std::string& text) {
        const auto number = number_from<T>(text);
        return number && *number >= low && *number <= high ? std::string()
                                                           : fmt::format("give {}, not '{}'", what, text);
    };
}

/// Accepts one of `words`.
ValueCheck one_of(std::vector<std::string> words);
/// Accept the path of an existing folder or an existing file.
ValueCheck existing_folder();
ValueCheck existing_file();
/// Accept a number above 0, or of at least 0.
ValueCheck positive_number();
ValueCheck non_negative_number();

/// An option or a positional argument of a command. A handle: copies name the same option.
class Option {
public:
    explicit Option(CLI::Option* option) : option_(option) {}

    /// Sets the placeholder of the value in the help, as in `WxH`.
    Option type_name(const std::string& name) const;
    /// Sets the default that the help shows; `capture_default_str` takes it from the bound variable.
    Option default_str(const std::string& text) const;
    Option capture_default_str() const;
    Option description(const std::string& text) const;
    Option check(const ValueCheck& check) const;
    Option required(bool required = true) const;
    Option needs(Option other) const;
    Option needs(const std::string& other) const;
    Option excludes(Option other) const;
    Option excludes(const std::string& other) const;
    /// Sets the heading under which the help lists the option; with an empty one it is listed nowhere.
    Option group(const std::string& heading) const;
    /// Splits a value into several at `separator`.
    Option delimiter(char separator) const;
    /// Keeps all values of an option that is given several times; without this the last one counts.
    Option take_all() const;
    /// Takes one argument per occurrence and leaves the next ones to others: by default CLI11 gives all of
    /// them to a vector option.
    Option one_word() const;
    /// Combines take_all() and one_word().
    Option repeatable() const;
    /// Calls `function` with each value while the command line is parsed.
    Option each(std::function<void(std::string)> function) const;

    /// Returns the texts of its values so far.
    std::vector<std::string> texts() const;
    /// Adds a value as if the user had given it. To be called from a check of an option that was added before
    /// this one, because values are read in that order.
    void add_text(const std::string& text) const;

    bool operator==(const Option&) const = default;

private:
    CLI::Option* option_;
};

/// A command with its options. A handle: copies name the same command, which the program owns.
class Command {
public:
    explicit Command(CLI::App& app) : app_(&app) {}

    std::string name() const;
    Command add_subcommand(const std::string& name, const std::string& description) const;
    /// Returns the direct sub-commands.
    std::vector<Command> subcommands() const;

    /// `names` as in `-o,--output`; a name without dashes is a positional argument. T is a type that
    /// command_line.cpp lists: a number, text, a path, an optional number or text, a list of texts.
    template <class T>
    Option add_option(const std::string& names, T& value, const std::string& description) const;
    /// Calls `function` with the value instead of storing it.
    Option add_option(const std::string& names, std::function<void(const std::string&)> function,
                      const std::string& description) const;
    Option add_flag(const std::string& names, bool& value, const std::string& description) const;
    Option add_flag(const std::string& names, std::function<void()> function,
                    const std::string& description) const;

    bool has_option(const std::string& name) const;
    /// Returns the option `name`, which must exist (asserted).
    Option option(const std::string& name) const;
    std::vector<Option> options() const;

    /// Calls `function` after parsing if this command was called.
    void on_call(std::function<void()> function) const;
    /// Requires exactly one of the sub-commands.
    void require_subcommand() const;

    /// Returns the arguments that were given to this command, without the options named in `except`.
    std::vector<std::string> typed_words(std::span<const std::string_view> except) const;

    CLI::App& app() const { return *app_; }

private:
    CLI::App* app_;
};

/// Returns an option's value, its default and the options it needs or excludes, for the help and the manual
/// pages: the same with every version of CLI11 (2.1 writes `NAME=DEFAULT`, 2.4 `NAME [DEFAULT]`).
std::string value_words(const CLI::Option& option);

/// Makes the help of `app` write options with `value_words`.
void format_help(CLI::App& app);

/// Parses `words` with the options that `declare` adds. The error message is CLI11's, except for --help and
/// --version.
Result<void> parse_words(const std::function<void(Command)>& declare, std::vector<std::string> words);

/// Ends the parsing with the error that the required argument `name` is missing. Call it from a function of
/// `on_call`.
[[noreturn]] void fail_for_missing(const std::string& name);

} // namespace tidemark::host
