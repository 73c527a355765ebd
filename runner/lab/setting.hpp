// Knobs of a scene given other values, for a study: a uniform, a #define or a const, by name, or a number
// without a name, by its place (placed_number.hpp); without an edit of the shader.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

using scene::Setting;

/// One knob and all values that a study gives it, from the coarsest to the strictest.
struct Axis {
    std::string name;
    std::vector<std::string> values;
};

/// `NAME=a,b,c`; commas inside parentheses belong to a value. `option` is named in the error
/// (ErrorCode::usage).
Result<Axis> parse_axis(std::string_view text, std::string_view option);

/// `NAME=V,NAME=V`. As above.
Result<std::vector<Setting>> parse_settings(std::string_view text, std::string_view option);

/// Each knob once, with the value that was given last: what apply would leave.
std::vector<Setting> merged(const std::vector<Setting>& settings);

/// `a = 1, b = 2`; "defaults" when there are none.
std::string to_string(const std::vector<Setting>& settings);

/// Whether it names a knob (`#iUniform`): its values are in no text.
bool is_knob(const scene::Scene& scene, std::string_view name);

/// Sets a knob, else rewrites a `#define` or `const`, else the number at a place. The error
/// (ErrorCode::usage) has the nearest name there is.
Result<void> apply(scene::Scene& scene, const Setting& setting);
Result<scene::Scene> with(scene::Scene scene, const std::vector<Setting>& settings);

/// What the scene has for that knob now, as apply would take it; empty when there is none.
std::string value_of(const scene::Scene& scene, std::string_view name);

} // namespace tidemark::lab
