// The part of a report about the precision in which a scene was drawn.
#pragma once

#include "render/renderer.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::cli {

/// Returns "single" or "double", the values of --precision.
std::string name_of(glsl::Precision precision);

/// Adds `precision`, and for double precision `float_hashes`: pass, function, file, line and kind of each
/// hash that stays in floats.
void add_precision(nlohmann::ordered_json& report, const render::Renderer& renderer);

/// Returns the same as text; empty in single precision.
std::string precision_lines(const render::Renderer& renderer);

} // namespace tidemark::cli
