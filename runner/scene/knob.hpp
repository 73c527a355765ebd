// A knob or a definition and its value, as the user wrote them.
#pragma once

#include "base/error.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

struct Setting {
    std::string name;
    std::string value;

    bool operator==(const Setting&) const = default;
};

/// Adds a setting, replacing an earlier one of the same name.
void set(std::vector<Setting>& settings, const Setting& setting);

// A knob: a uniform that the scene declares with `#iUniform` for the user to change.

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
};

/// Parses `0.5`, `1,2,3`, `vec3(1, 2, 3)` or, for a colour, `#rrggbb`. One number sets all components;
/// `default` is the scene's default. The error (ErrorCode::usage) says what the knob accepts.
Result<KnobValue> parse_knob_value(const Knob& knob, std::string_view text);

inline constexpr std::string_view k_default_value = "default";

/// Returns the value after applying the settings in order: the last valid one counts.
KnobValue value_after(const Knob& knob, std::span<const Setting> settings);

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

/// Formats the knob's value as in a directive, which has its own name for colours: `color3(1, 0.5, 0)`.
std::string to_literal(const Knob& knob);

// Writes values of knobs into the `#iUniform` lines that declare them. Text in, text out: reads and writes no
// files.

/// Returns the text of a file with the value of each of these knobs as its default; nothing else changes.
/// Fails (ErrorCode::write) if it does not declare one of them.
Result<std::string> with_defaults(std::string_view text, const std::vector<Knob>& knobs);

} // namespace tidemark::scene
