// A knob: a uniform that the scene declares with `#iUniform` for a person to turn.
#pragma once

#include "base/result.hpp"
#include "scene/setting.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

enum class KnobType { float1, vec2, vec3, vec4, color3, int1, ivec2, ivec3, ivec4 };

/// The type as the directive and as GLSL spell it, how many components it has, whether they are whole.
struct KnobTypeInfo {
    KnobType type;
    std::string_view directive_name;
    std::string_view glsl_name;
    int components;
    bool whole;
};

const KnobTypeInfo& info(KnobType type);
const KnobTypeInfo* find_knob_type(std::string_view directive_name);

/// One number for each component; those that the type lacks stay 0.
using KnobValue = std::array<double, 4>;

struct KnobRange {
    KnobValue low;
    KnobValue high;
};

struct Knob {
    std::string name;
    KnobType type = KnobType::float1;
    KnobValue initial{}; ///< as the scene declares it
    KnobValue value{};
    std::optional<KnobRange> range{}; ///< what a slider offers; a value may lie outside
    std::optional<KnobValue> step{};
    SourceLocation where{};
};

/// Reads `0.5`, `1,2,3`, `vec3(1, 2, 3)`, or, for a colour, `#rrggbb`. One number stands for all components;
/// `default` is what the scene declares. The error (ErrorCode::usage) says what the knob takes.
Result<KnobValue> parse_knob_value(const Knob& knob, std::string_view text);

inline constexpr std::string_view k_default_value = "default";

/// What it is once it was set to these in turn: the last that it takes decides.
KnobValue value_after(const Knob& knob, std::span<const Setting> settings);

/// Whether a component of a whole-number type can hold `number`, which is whole.
inline bool fits_int(double number) {
    return number >= -2147483648.0 && number <= 2147483647.0;
}

/// The knob of that name, or an error with the nearest name there is.
Result<Knob*> find_knob(std::vector<Knob>& knobs, std::string_view name);

/// `0.5`, `vec3(1, 2, 3)`: a value of the knob as a person writes it in GLSL.
std::string to_string(const Knob& knob, const KnobValue& value);
inline std::string to_string(const Knob& knob) {
    return to_string(knob, knob.value);
}

/// The same as a directive has it, which calls a colour by its own name: `color3(1, 0.5, 0)`.
std::string to_literal(const Knob& knob);

} // namespace tidemark::scene
