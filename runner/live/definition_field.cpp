#include "live/definition_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tidemark::live {

std::optional<DefinitionField> definition_field(std::string_view name, std::string_view text, bool held) {
    DefinitionField field{.name = std::string(name), .held = held};
    const std::string_view digits = text.substr(text.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), field.value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(field.value))
        return std::nullopt;
    field.whole = digits.find_first_of(".eE") == std::string_view::npos;
    return field;
}

void keep_changing(const std::vector<DefinitionField>& before, std::vector<DefinitionField>& now) {
    for (DefinitionField& field : now) {
        const auto old = std::ranges::find(before, field.name, &DefinitionField::name);
        if (old != before.end() && old->changing) {
            field.value = old->value;
            field.changing = true;
        }
    }
}

std::string text_of(const DefinitionField& field) {
    if (field.whole)
        return fmt::format("{:.0f}", field.value);
    const std::string text = fmt::format("{}", field.value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

} // namespace tidemark::live
