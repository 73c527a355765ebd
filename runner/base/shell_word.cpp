#include "base/shell_word.hpp"

#include "base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark {
namespace {

/// Quotes as `$'…'` (bash, zsh, POSIX.1-2024), with control characters as escapes: octal, of which a shell
/// reads at most three digits.
std::string spelled_out(std::string_view word) {
    std::string quoted = "$'";
    while (!word.empty()) {
        const size_t length = first_character(word).length;
        const std::string_view character = word.substr(0, length);
        word.remove_prefix(length);
        if (character == "'" || character == "\\")
            quoted += '\\';
        if (is_printable_line(character))
            quoted += character;
        else
            for (const char byte : character)
                quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(byte));
    }
    return quoted + "'";
}

} // namespace

std::string shell_word(std::string_view word) {
    constexpr std::string_view k_safe =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,=@%";
    if (!word.empty() && word.find_first_not_of(k_safe) == word.npos)
        return std::string(word);
    if (!is_printable_line(word))
        return spelled_out(word);
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string shell_words(std::span<const std::string> words) {
    std::string line;
    for (const std::string& word : words)
        line.append(line.empty() ? "" : " ").append(shell_word(word));
    return line;
}

std::vector<std::string> split_words(std::string_view words) {
    std::vector<std::string> found;
    while (true) {
        words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
        if (words.empty())
            return found;
        found.emplace_back(words.substr(0, words.find(' ')));
        words.remove_prefix(found.back().size());
    }
}

} // namespace tidemark
