// Numbers that have no name in a scene's text: called by the place where they stand, FILE:LINE:COLUMN.
#pragma once

#include "glsl/cure/cure.hpp"
#include "scene/scene.hpp"
#include "scene/setting.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::lab {

/// As compilers name a place.
std::string place_name(const SourceLocation& where);

/// The number that stands at that place; nothing where `place` is none, or no number stands there.
std::optional<glsl::WrittenWord> number_at(const scene::Scene& scene, std::string_view place);

/// Another number in its stead.
glsl::Cure replaced(const glsl::WrittenWord& number, const std::string& value);

} // namespace tidemark::lab
