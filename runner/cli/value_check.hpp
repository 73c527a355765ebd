// Checks of an option's value that say what to give: CLI11's own words do not, and it prints its checks'
// names in the help.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <vector>

namespace tidemark::cli {

/// A number from `low` to `high`; `what` completes "give …".
template <class T>
CLI::Validator number(std::string what, T low = std::numeric_limits<T>::lowest(),
                      T high = std::numeric_limits<T>::max()) {
    return CLI::Validator(
        [what = std::move(what), low, high](const std::string& text) {
            T number{};
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool good =
                error == std::errc{} && end == text.data() + text.size() && number >= low && number <= high;
            return good ? std::string() : fmt::format("give {}, not '{}'", what, text);
        },
        std::string());
}

inline CLI::Validator one_of(std::vector<std::string> words) {
    return CLI::Validator(
        [words = std::move(words)](const std::string& text) {
            return std::ranges::find(words, text) != words.end()
                       ? std::string()
                       : fmt::format("give {}, not '{}'", fmt::join(words, " or "), text);
        },
        std::string());
}

/// CLI11's own, without its name in the help.
inline CLI::Validator unnamed(const CLI::Validator& validator) {
    return validator.description("");
}

} // namespace tidemark::cli
