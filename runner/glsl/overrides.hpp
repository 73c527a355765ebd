// `--define NAME=VALUE`: replaces the body of the scene's `#define NAME` or the value of its `const … NAME`.
#pragma once

#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// The names that can be replaced, each once.
std::vector<std::string> definition_names(const scene::Scene& scene);

struct NamedText {
    std::string name;
    std::string text;
    std::string file{}; ///< in which it is written
};

/// What the scene defines names as: the text of each one's first definition that no #if takes out.
std::vector<NamedText> definitions_of(const scene::Scene& scene);

/// Those of them whose text is one number, with its sign.
std::vector<NamedText> plain_numbers(const scene::Scene& scene);

/// The same of one name; a value that is itself such a name is followed.
std::optional<std::string> definition_of(const scene::Scene& scene, std::string_view name);

/// Rewrites every definition of NAME in Common and every pass. The error (ErrorCode::usage) names the nearest
/// definition there is. Macros with parameters and values over several lines are left alone.
Result<void> override_definition(scene::Scene& scene, std::string_view setting);

/// Has each NAME stand for a variable instead, wherever it is defined: a `const` becomes a plain global, for
/// what it stands for is no constant. Names that the scene does not define are left.
void define_by_variables(scene::Scene& scene, std::span<const scene::Setting> variables);

/// As override_definition, in the text of one file, if it defines NAME.
void override_definition(std::string& text, const scene::Setting& setting);

} // namespace tidemark::glsl
