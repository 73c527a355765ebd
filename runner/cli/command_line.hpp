// The command line as the commands declare it. CLI11 parses it; only command_line.cpp, app.cpp and the pages
// made from the options (help/) include CLI11, which takes seconds to compile.
#pragma once

#include "base/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
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

namespace tidemark::cli {

/// Checks the text of a value: returns what to give instead, or an empty string where the value is good.
using ValueCheck = std::function<std::string(const std::string&)>;

/// Accepts a number from `low` to `high`; `what` completes "give …".
template <class T>
ValueCheck number(std::string what, T low = std::numeric_limits<T>::lowest(),
                  T high = std::numeric_limits<T>::max()) {
    return [what = std::move(what), low, high](const std::string& text) {
        T number{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        const bool good =
            error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high;
        return good ? std::string() : fmt::format("give {}, not '{}'", what, text);
    };
}

/// Accepts one of `words`.
ValueCheck one_of(std::vector<std::string> words);
/// Accepts the path of a folder, or of a file, that exists.
ValueCheck existing_folder();
ValueCheck existing_file();
/// Accept a number above 0, or from 0 on.
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
    /// Sets the heading under which the help lists it.
    Option group(const std::string& heading) const;
    /// Splits a value into several at `separator`.
    Option delimiter(char separator) const;
    /// Keeps all values where it is given several times; without this the last one counts.
    Option take_all() const;
    /// Leaves the words after its value to others: CLI11 gives all of them to an option of a vector.
    Option one_word() const;
    /// Both of these.
    Option repeatable() const;
    /// Calls `function` with each value, when the line is parsed.
    Option each(std::function<void(std::string)> function) const;

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
    /// The commands below this one.
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
    /// Asserts that there is one.
    Option option(const std::string& name) const;
    std::vector<Option> options() const;

    /// Calls `function` once the line is parsed, where this command is the one that was called.
    void on_call(std::function<void()> function) const;
    /// Asks for exactly one of the subcommands.
    void require_subcommand() const;

    /// The words that were typed for this command, less the options named in `except`.
    std::vector<std::string> typed_words(std::span<const std::string_view> except) const;

    CLI::App& app() const { return *app_; }

private:
    CLI::App* app_;
};

/// Parses `words` by the options that `declare` adds. The error is CLI11's.
Result<void> parse_words(const std::function<void(Command)>& declare, std::vector<std::string> words);

/// Ends the parsing, from a function of `on_call`: the argument `name` is required and was not given.
[[noreturn]] void fail_for_missing(const std::string& name);

} // namespace tidemark::cli
