// Settings for a study: assigns values to a scene's knobs (uniform, #define or const, by name) and to unnamed
// numbers (by place, placed_number.hpp). It changes the scene in memory only.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

using scene::Setting;

/// A name and all values that a study assigns to it, from the coarsest to the strictest.
struct Axis {
    std::string name;
    std::vector<std::string> values;
};

/// Parses `NAME=a,b,c`; commas inside parentheses belong to a value. Errors (ErrorCode::usage) name `option`.
Result<Axis> parse_axis(std::string_view text, std::string_view option);

/// Parses `NAME=V,NAME=V`, with the same errors.
Result<std::vector<Setting>> parse_settings(std::string_view text, std::string_view option);

/// Returns each name once, with its last value: the result of applying all in order.
std::vector<Setting> merged(const std::vector<Setting>& settings);

/// Returns `a = 1, b = 2`, or "defaults" if there are none.
std::string to_string(const std::vector<Setting>& settings);

/// Returns whether the name is a knob (`#iUniform`), whose value is not in the text.
bool is_knob(const scene::Scene& scene, std::string_view name);

/// Sets a knob, else rewrites a `#define` or `const`, else the number at a place. The error for an unknown
/// name (ErrorCode::usage) suggests the nearest name.
Result<void> apply(scene::Scene& scene, const Setting& setting);
Result<scene::Scene> with(scene::Scene scene, const std::vector<Setting>& settings);

/// Returns the current value in the form that `apply` takes; empty if the name is unknown.
std::string value_of(const scene::Scene& scene, std::string_view name);

} // namespace tidemark::lab
