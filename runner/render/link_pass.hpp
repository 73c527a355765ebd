// From a pass of a scene to a linked program, through the dialects of GLSL that its text may be written in.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "glsl/dialect.hpp"
#include "glsl/double/promote.hpp"
#include "glsl/specialise/specialise.hpp"
#include "scene/scene.hpp"

namespace tidemark::render {

struct LinkedPass {
    gl::Program program;
    /// What it was linked as. Its kinds of channels may differ from the scene's where the scene says nothing:
    /// the text wants a cube or a volume there.
    glsl::Dialect dialect;
    std::vector<glsl::KeptHash> hashes{}; ///< in floats, in a program of doubles
    glsl::LeftOut left_out{};
    bool discards = false; ///< as glsl::PassReading has it
};

/// How a pass is compiled.
struct LinkOptions {
    glsl::Precision precision = glsl::Precision::single;
    glsl::Specialise specialise = glsl::Specialise::nothing;
    bool tiled = false;            ///< as glsl::Dialect has it
    bool marks_non_finite = false; ///< likewise
    bool keeps_alpha = false;      ///< likewise
};

/// The error has the authors' own files and lines. A specialised text that does not link is not used.
Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options);

} // namespace tidemark::render
