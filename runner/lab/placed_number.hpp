// Unnamed number literals of a scene's text, addressed by place: FILE:LINE:COLUMN.
#pragma once

#include "glsl/cure/cure.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// Returns the place as FILE:LINE:COLUMN, as compilers write it.
std::string place_name(const SourceLocation& where);

/// Returns the number literal at that place, or nothing if `place` is malformed or no number starts there.
std::optional<glsl::WrittenWord> number_at(const scene::Scene& scene, std::string_view place);

/// Returns the change that replaces the number by `value`.
glsl::Cure replaced(const glsl::WrittenWord& number, const std::string& value);

} // namespace tidemark::lab
