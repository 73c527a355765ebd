#include "glsl/instruction_count.hpp"

#include "base/trimmed.hpp"

#include <charconv>

namespace tidemark::glsl {
namespace {

/// Drivers also end a message with a NUL.
constexpr std::string_view k_blanks{" \n\0", 3};

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Reads a count; the whole of `text` must be digits.
std::optional<int> count_of(std::string_view text) {
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (text.empty() || !is_digit(text.front()) || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return count;
}

/// Reads `123 inst` or `inst: 123`; the whole item must match.
std::optional<int> count_in(std::string_view item) {
    for (const std::string_view word : {" instructions", " inst"})
        if (item.ends_with(word))
            return count_of(item.substr(0, item.size() - word.size()));
    constexpr std::string_view k_name = "inst: ";
    return item.starts_with(k_name) ? count_of(item.substr(k_name.size())) : std::nullopt;
}

} // namespace

std::optional<InstructionCount> read_instruction_count(std::string_view message) {
    message = trimmed(message, k_blanks);
    const std::string_view first = message.substr(0, message.find(','));
    const size_t colon = first.rfind(": ");
    if (colon == std::string_view::npos)
        return std::nullopt;
    const std::string_view name = first.substr(0, colon);
    constexpr std::string_view k_shader = " shader";
    if (name.ends_with(k_shader) || name.find(" prog ") != std::string_view::npos) {
        const auto count = count_in(first.substr(colon + 2));
        const size_t bare = name.size() - (name.ends_with(k_shader) ? k_shader.size() : 0);
        return count ? std::optional(InstructionCount{std::string(name.substr(0, bare)), *count})
                     : std::nullopt;
    }
    if (name != "type")
        return std::nullopt;
    for (std::string_view rest = message.substr(first.size()); !rest.empty();) {
        rest.remove_prefix(1);
        const std::string_view item = rest.substr(0, rest.find(','));
        if (const auto count = count_in(trimmed(item, k_blanks)))
            return InstructionCount{std::string(first), *count};
        rest.remove_prefix(item.size());
    }
    return std::nullopt;
}

} // namespace tidemark::glsl
