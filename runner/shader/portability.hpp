// `tidemark check --portable`: finds code that a desktop driver accepts but ShaderToy's compiler (GLSL ES
// 3.00, in a browser) will reject. Reads the texts only and reports only certain problems; an ES compiler
// finds the rest (PassReading::site_source).
#pragma once

#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/pass_reading.hpp"
#include "shader/shader_source.hpp"
#include "shader/token_reading.hpp"

#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Returns one warning for each place, with a replacement, in the order of the scene's passes (Common first).
std::vector<Diagnostic> portability_lint(const scene::Scene& scene);

/// Returns whether a driver's message is about something that ShaderToy accepts: an unnamed parameter, or a
/// built-in function that the text redefines.
bool is_taken_by_the_site(const PassReading& reading, std::string_view message);

// Applies what ShaderToy's compiler (ANGLE) does and desktop drivers do not: gives a zero to everything that
// starts without a value (variables of every type, `out` parameters, the result of a function that ends
// without a `return`), and a name to unnamed parameters. Text in, text out; no line moves.

/// Changes a text that is complete except for its #version. Variables that have a value before each read, on
/// every path, are left unchanged. Falls back to initialise_plain if the parser fails.
void start_at_zero(text::MappedText& text, Version version);

/// Does the same from tokens alone: for every variable and `out` parameter of a built-in type, in macro
/// bodies too. Arrays and variables of the author's own types are left unchanged.
std::vector<text::Edit> initialise_plain(const std::vector<text::Token>& tokens,
                                         const Preprocessed& preprocessed);

} // namespace tidemark::glsl
