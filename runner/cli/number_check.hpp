// A check of an option's value that says what to give: CLI11's own words for a text that is no number do not.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <string>

namespace tidemark::cli {

/// `what` completes "give …".
template <class T>
CLI::Validator number(std::string what) {
    return CLI::Validator(
        [what = std::move(what)](const std::string& text) {
            T number{};
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
            const bool good = error == std::errc{} && end == text.data() + text.size();
            return good ? std::string() : fmt::format("give {}, not '{}'", what, text);
        },
        std::string());
}

} // namespace tidemark::cli
