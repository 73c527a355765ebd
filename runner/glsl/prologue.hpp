// Generated code around an author's text: the lines before it, and the `main` that calls its entry point.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/survey.hpp"
#include "scene/scene.hpp"

#include <span>
#include <string>

namespace tidemark::glsl {

/// Returns #version and the lines that must follow it directly, which promotion must not change. `extensions`
/// are the author's #extension lines.
std::string version_lines(const Dialect& dialect, std::span<const std::string> extensions);

/// Returns the lines between version_lines and the author's text: macros, uniforms, output, helper functions.
std::string prologue(const scene::Scene& scene, const scene::Pass& pass, const Survey& survey,
                     const Dialect& dialect);

/// Returns everything that ShaderToy puts before a text; no aliases for old names and no knobs.
std::string site_prologue(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

struct Wrapper {
    std::string prototype; ///< lets `main` come first
    std::string main;
};

Wrapper wrapper(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

/// Returns `isKeyDown(int)` and related functions, with the VS Code extension's `Key_` constants:
/// `#iKeyboard`.
std::string keyboard_helpers();

} // namespace tidemark::glsl
