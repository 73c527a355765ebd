// A `#define` or `const` that is one number, as a field that a hand changes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::live {

struct DefinitionField {
    std::string name;
    double value = 0;
    bool whole = false;    ///< written without a point: it may size an array or count turns
    bool held = false;     ///< replaced: not as the file has it
    bool changing = false; ///< under somebody's hand

    bool operator==(const DefinitionField&) const = default;
};

/// Nothing where the text is no decimal number that GLSL reads without a suffix.
std::optional<DefinitionField> definition_field(std::string_view name, std::string_view text, bool held);

/// What is under somebody's hand stays as it is there.
void keep_changing(const std::vector<DefinitionField>& before, std::vector<DefinitionField>& now);

/// The value as GLSL takes it, with a point where the file has one.
std::string text_of(const DefinitionField& field);

} // namespace tidemark::live
