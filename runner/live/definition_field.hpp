// A `#define` or `const` that is one number, as a field that can be edited.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::live {

struct DefinitionField {
    std::string name;
    double value = 0;
    bool whole = false;    ///< written without a decimal point: it may be an array size or a loop count
    bool held = false;     ///< replaced by --define or an edit, so it differs from the file
    bool changing = false; ///< being edited

    bool operator==(const DefinitionField&) const = default;
};

/// Returns a field, or nothing where the text is not a finite decimal number in GLSL without a suffix.
std::optional<DefinitionField> definition_field(std::string_view name, std::string_view text, bool held);

/// Copies the values that are being edited from `before` to `now`.
void keep_changing(const std::vector<DefinitionField>& before, std::vector<DefinitionField>& now);

/// Returns the value as GLSL text, with a decimal point where the file has one.
std::string text_of(const DefinitionField& field);

} // namespace tidemark::live
