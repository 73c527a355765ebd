// Finds problems that compilers accept: uninitialised values, derivatives in non-uniform control flow,
// miscounting float loops, and code that ShaderToy's own site does not compile.
#pragma once

#include "glsl/dialect.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// The hints of one scene, which must outlive it. A context must be current.
class Hints {
public:
    explicit Hints(const scene::Scene& scene) : scene_(scene) {}

    /// Adds the hints of a pass that was linked in that dialect.
    void read(const scene::Pass& pass, const glsl::Dialect& dialect);
    /// Returns all hints, except on lines with a problem. `compile`: also compiles for ShaderToy's site,
    /// unless there are errors.
    std::vector<Diagnostic> take(const std::vector<Diagnostic>& problems, bool compile);

private:
    void add(SourceLocation where, std::string message);

    const scene::Scene& scene_;
    std::vector<Diagnostic> found_;
};

} // namespace tidemark::cli
