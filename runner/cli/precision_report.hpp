// What a report says of the precision that a scene was drawn in.
#pragma once

#include "render/renderer.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::cli {

/// "single" or "double", as --precision has it.
std::string name_of(glsl::Precision precision);

/// `precision`, and of a promoted scene `float_hashes`: pass, function, file, line and kind of each.
void add_precision(nlohmann::ordered_json& report, const render::Renderer& renderer);

/// The same for people; nothing in single precision.
std::string precision_lines(const render::Renderer& renderer);

} // namespace tidemark::cli
