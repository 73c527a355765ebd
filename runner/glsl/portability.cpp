#include "glsl/portability.hpp"

namespace tidemark::glsl {

std::vector<Diagnostic> portability_lint(const scene::Scene&) {
    return {};
}

} // namespace tidemark::glsl
