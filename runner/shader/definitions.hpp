// `--define NAME=VALUE`: replaces the body of the scene's `#define NAME` or the value of its `const … NAME`.
#pragma once

#include "scene/knob.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns the names that can be replaced, once each.
std::vector<std::string> definition_names(const scene::Scene& scene);

struct NamedText {
    std::string name;
    std::string text;
    std::string file{}; ///< file that contains it
};

/// Returns each defined name with the text of its first definition that is not in an inactive #if.
std::vector<NamedText> definitions_of(const scene::Scene& scene);

/// Returns the definitions whose text is one number with an optional sign.
std::vector<NamedText> plain_numbers(const scene::Scene& scene);

/// Returns the value of one name; a value that is itself a defined name is resolved.
std::optional<std::string> definition_of(const scene::Scene& scene, std::string_view name);

/// Rewrites every definition of NAME in Common and all passes. The error (ErrorCode::usage) suggests the
/// nearest defined name. Macros with parameters are left unchanged; a VALUE of several lines is an error.
Result<void> override_definition(scene::Scene& scene, std::string_view setting);

/// Replaces each NAME by a variable wherever it is defined; a `const` becomes a plain global, since its value
/// is no longer constant. Names that the scene does not define are ignored.
void define_by_variables(scene::Scene& scene, std::span<const scene::Setting> variables);

/// Does the same as override_definition above, in the text of one file, if it defines NAME.
void override_definition(std::string& text, const scene::Setting& setting);

} // namespace tidemark::glsl
