// What a driver says about a shader, turned into messages about the author's own lines.
#pragma once

#include "base/error.hpp"
#include "text/mapped_text.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// One diagnostic for each line of the log. Reads the forms of Mesa `0:12(5): error: …`, NVIDIA
/// `0(12) : error C1008: …`, and Intel, AMD and ANGLE `ERROR: 0:12: …`. A line in none of these forms, and
/// one about a line of our own making, has no place. Of the overloads that Mesa lists where none fits a call,
/// three are kept, as notes.
std::vector<Diagnostic> parse_driver_log(std::string_view log, const text::LineMap& lines);

} // namespace tidemark::glsl
