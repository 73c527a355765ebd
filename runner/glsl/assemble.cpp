#include "glsl/assemble.hpp"

#include "glsl/pass_reading.hpp"

#include <cassert>

namespace tidemark::glsl {

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass) {
    const PassReading reading(scene, pass);
    return std::move(reading.assemble(reading.dialects(Precision::single).front())->source);
}

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect& dialect) {
    assert(dialect.precision == Precision::single);
    return std::move(PassReading(scene, pass).assemble(dialect)->source);
}

const char* const k_vertex_shader = R"(#version 330 core
uniform vec2 tidemark_tile;
flat out vec2 tidemark_corner;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    tidemark_corner = tidemark_tile;
}
)";

const char* vertex_shader(Version version) {
    return version != Version::es_300 ? k_vertex_shader : R"(#version 300 es
uniform vec2 tidemark_tile;
flat out vec2 tidemark_corner;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
    tidemark_corner = tidemark_tile;
}
)";
}

} // namespace tidemark::glsl
