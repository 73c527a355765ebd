// Knobs and their values, which are numbers everywhere but in text that a user wrote or reads; definitions
// and their values, which are text.
#pragma once

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::text {
struct Edit;
}

namespace tidemark::scene {

/// A definition and its text. In a study, also a knob.
struct Setting {
    std::string name;
    std::string value;

    bool operator==(const Setting&) const = default;
};

/// Adds a setting, replacing an earlier one of the same name.
template <class T>
void set(std::vector<T>& settings, const T& setting) {
    const auto known = std::ranges::find(settings, setting.name, &T::name);
    if (known == settings.end())
        settings.push_back(setting);
    else
        *known = setting;
}

// A knob: a uniform for the user to change, which the scene declares with `#iUniform`, or with `uniform`
// alone in a text for another host.

enum class KnobType { float1, vec2, vec3, vec4, color3, int1, ivec2, ivec3, ivec4 };

/// A type's names in directives and in GLSL, its number of components, and whether they are integers.
struct KnobTypeInfo {
    KnobType type;
    std::string_view directive_name;
    std::string_view glsl_name;
    int components;
    bool whole;
};

const KnobTypeInfo& info(KnobType type);
const KnobTypeInfo* find_knob_type(std::string_view directive_name);

/// One number per component; unused components are 0.
using KnobValue = std::array<double, 4>;

struct KnobRange {
    KnobValue low;
    KnobValue high;
};

struct Knob {
    std::string name;
    KnobType type = KnobType::float1;
    KnobValue initial{}; ///< the scene's default
    KnobValue value{};
    std::optional<KnobRange> range{}; ///< a slider's range; a value may lie outside
    std::optional<KnobValue> step{};
    SourceLocation where{};
    bool plain = false; ///< declared as `uniform float NAME;` in the text itself
};

/// A value given for a knob. It can be parsed and printed without the scene that declares the knob.
struct GivenValue {
    int count = 0; ///< of the numbers, 1 to 4; one number sets all components; 0: the scene's default
    KnobValue numbers{};
    std::optional<KnobType> type{}; ///< as in `vec3(1, 2, 3)`; none: numbers alone, which suit every type

    bool operator==(const GivenValue&) const = default;
};

/// A knob's name and a value given for it.
struct KnobSetting {
    std::string name;
    GivenValue value{};

    bool operator==(const KnobSetting&) const = default;
};

/// Parses `0.5`, `1,2,3`, `vec3(1, 2, 3)`, `#rrggbb` or `default`. The error (ErrorCode::usage) contains the
/// name of the knob and the accepted forms.
Result<KnobSetting> parse_knob_setting(std::string_view name, std::string_view text);

/// Formats a value as parse_knob_setting() reads it; the same numbers come back.
std::string to_string(const GivenValue& value);

/// Returns the setting that gives the knob this value.
KnobSetting setting_of(const Knob& knob, const KnobValue& value);

/// Returns the knob's value. The error (ErrorCode::usage) says what the knob accepts: numbers that are too
/// many or too few, not whole, not finite, or of another type are refused.
Result<KnobValue> value_for(const Knob& knob, const GivenValue& given);

/// Parses a value and checks it for the knob, with the errors of value_for().
Result<KnobValue> parse_knob_value(const Knob& knob, std::string_view text);

/// Sets the knob that the setting names. Fails (ErrorCode::usage) if there is none or it refuses the value.
Result<void> set_knob(std::vector<Knob>& knobs, const KnobSetting& setting);

/// Returns the value after the settings: the last one for this knob counts. A setting that the knob refuses
/// is skipped; those who take settings in check them with value_for().
KnobValue value_after(const Knob& knob, std::span<const KnobSetting> settings);

/// Returns whether `number`, an integer, fits a component of an integer type.
inline bool fits_int(double number) {
    return number >= -2147483648.0 && number <= 2147483647.0;
}

/// Returns the knob of that name, or an error that suggests the nearest name.
Result<Knob*> find_knob(std::vector<Knob>& knobs, std::string_view name);

/// Formats a value of the knob as in GLSL: `0.5`, `vec3(1, 2, 3)`.
std::string to_string(const Knob& knob, const KnobValue& value);
inline std::string to_string(const Knob& knob) {
    return to_string(knob, knob.value);
}

/// Formats the knob's value as GLSL of the type that its declaration has: `2.0`, `vec2(1, 0.5)`, `true`.
std::string as_glsl(const Knob& knob, std::string_view type);

/// Formats the knob's value as in a directive, which has its own name for colours: `color3(1, 0.5, 0)`.
std::string to_literal(const Knob& knob);

// Writes values of knobs into the `#iUniform` lines that declare them. Text in, text out: reads and writes no
// files.

/// Returns the text of a file with the value of each of these knobs as its default; nothing else changes.
/// Fails (ErrorCode::write) if it does not declare one of them.
Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs);

/// Returns edits that remove the defaults of plain knobs, as in `uniform float a = 1.0;`: GLSL ES has none.
std::vector<text::Edit> without_plain_defaults(std::string_view text, const std::vector<Knob>& knobs);

/// Returns the text with plain knobs as constants: `uniform float a;` becomes `const float a = 0.5;`.
/// Unchanged: declarations with a layout, and those that also declare other names.
std::string with_plain_knobs_as_constants(std::string_view text, const std::vector<Knob>& knobs);

} // namespace tidemark::scene
