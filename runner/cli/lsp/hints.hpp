// What no compiler complains of: values that are read before they are there, derivatives where neighbours may
// have gone another way, and what ShaderToy's own site will not compile.
#pragma once

#include "glsl/dialect.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Of one scene, which must live as long. A context must be current.
class Hints {
public:
    explicit Hints(const scene::Scene& scene) : scene_(scene) {}

    /// Of a pass that was linked in that dialect.
    void read(const scene::Pass& pass, const glsl::Dialect& dialect);
    /// All of them, without those of lines that have a problem. `compile`: the site's dialect is compiled,
    /// too.
    std::vector<Diagnostic> take(const std::vector<Diagnostic>& problems, bool compile);

private:
    void add(SourceLocation where, std::string message);

    const scene::Scene& scene_;
    std::vector<Diagnostic> found_;
};

} // namespace tidemark::cli
