// Our own lines around an author's text: what stands before it, and the `main` that calls its entry point.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/survey.hpp"
#include "scene/scene.hpp"

#include <span>
#include <string>

namespace tidemark::glsl {

/// #version and what must follow it at once; what every text needs untouched. `extensions` are the author's
/// own lines that go to the top.
std::string version_lines(const Dialect& dialect, std::span<const std::string> extensions);

/// From there to the last helper.
std::string prologue(const scene::Scene& scene, const scene::Pass& pass, const Survey& survey,
                     const Dialect& dialect);

/// All that the site puts in front of a text. It has no old names and no knobs.
std::string site_prologue(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

struct Wrapper {
    std::string prototype; ///< so that `main` can stand first
    std::string main;
};

Wrapper wrapper(const scene::Pass& pass, const Survey& survey, const Dialect& dialect);

/// `isKeyDown(int)` and its kind, with the `Key_` constants of the VS Code extension: `#iKeyboard`.
std::string keyboard_helpers();

} // namespace tidemark::glsl
