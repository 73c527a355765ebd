// Links a pass of a scene, trying the dialects of GLSL that its text may be written in.
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
    /// Dialect that linked. Its channel kinds differ from the scene's if the text samples a cube or a volume
    /// in a channel that the scene leaves unspecified.
    glsl::Dialect dialect;
    std::vector<glsl::KeptHash> hashes{}; ///< hashes kept in floats in a promoted program
    glsl::LeftOut left_out{};
    bool discards = false; ///< as in glsl::PassReading
};

/// Compile options of a pass.
struct LinkOptions {
    glsl::Precision precision = glsl::Precision::single;
    glsl::Specialise specialise = glsl::Specialise::nothing;
    bool tiled = false;            ///< as in glsl::Dialect
    bool marks_non_finite = false; ///< as in glsl::Dialect
    bool keeps_alpha = false;      ///< as in glsl::Dialect
};

/// Links the pass. Errors have the authors' own files and lines. If the specialised text does not link, the
/// whole text is linked.
Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options);

} // namespace tidemark::render
