// From a pass of a scene to a linked program, through the dialects of GLSL that its text may be written in.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "scene/scene.hpp"

namespace tidemark::render {

/// The error has the authors' own files and lines.
Result<gl::Program> link_pass(const scene::Scene& scene, const scene::Pass& pass);

} // namespace tidemark::render
