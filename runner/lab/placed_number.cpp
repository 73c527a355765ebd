#include "lab/placed_number.hpp"

#include "text/tokens.hpp"

#include <fmt/format.h>

#include <charconv>

namespace tidemark::lab {
namespace {

/// Removes a trailing `:N` from `text` and returns N, or returns 0 if there is none.
int take_number(std::string_view& text) {
    const size_t colon = text.rfind(':');
    if (colon == text.npos)
        return 0;
    const std::string_view digits = text.substr(colon + 1);
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size() || number < 1)
        return 0;
    text = text.substr(0, colon);
    return number;
}

std::optional<SourceLocation> place_of(std::string_view name) {
    const int column = take_number(name);
    const int line = column > 0 ? take_number(name) : 0;
    return line > 0 ? std::optional(SourceLocation{std::string(name), line, column}) : std::nullopt;
}

std::optional<glsl::WrittenWord> number_in(const text::MappedText& text, const SourceLocation& place) {
    for (const text::Token& token : text::tokenize(text.text()))
        if (token.kind == text::TokenKind::number && text.lines().locate(token.line, token.column) == place)
            return glsl::WrittenWord{place, std::string(token.text)};
    return std::nullopt;
}

} // namespace

std::string place_name(const SourceLocation& where) {
    return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

std::optional<glsl::WrittenWord> number_at(const scene::Scene& scene, std::string_view name) {
    const auto place = place_of(name);
    if (!place)
        return std::nullopt;
    auto found = number_in(scene.common, *place);
    for (size_t i = 0; !found && i < scene.passes.size(); ++i)
        found = number_in(scene.passes[i].text, *place);
    return found;
}

glsl::Cure replaced(const glsl::WrittenWord& number, const std::string& value) {
    return {{{number, number, value, "", true}}, ""};
}

} // namespace tidemark::lab
