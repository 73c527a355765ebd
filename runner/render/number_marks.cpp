#include "render/number_marks.hpp"

#include "glsl/assemble.hpp"

#include <array>

namespace tidemark::render {
namespace {

/// By the bits, which no optimiser takes for granted.
constexpr const char* k_text = R"(#version 450 core
layout(binding = 0) uniform sampler2D picture;
uniform vec2 extent; // of the window
out vec4 colour;
void main() {
    ivec2 size = textureSize(picture, 0);
    vec4 value = texelFetch(picture, min(ivec2(gl_FragCoord.xy / extent * vec2(size)), size - 1), 0);
    uvec4 magnitude = floatBitsToUint(value) & 0x7fffffffu;
    if (any(greaterThan(magnitude, uvec4(0x7f800000u))))
        colour = vec4(1.0, 0.0, 1.0, 1.0);
    else if (any(equal(magnitude, uvec4(0x7f800000u))))
        colour = vec4(0.0, 1.0, 0.0, 1.0);
    else if (any(lessThan(value, vec4(0.0))))
        colour = vec4(0.0, 0.0, 1.0, 1.0);
    else
        discard;
}
)";

} // namespace

Result<NumberMarks> NumberMarks::create() {
    auto program = gl::Program::link(glsl::k_vertex_shader, k_text);
    if (!program)
        return fail(ErrorCode::load, "the driver refuses the shader of the marks: " + program.error());
    GLuint vertex_array = 0;
    glCreateVertexArrays(1, &vertex_array);
    return NumberMarks(*std::move(program), gl::VertexArrayHandle(vertex_array));
}

void NumberMarks::draw(const gl::Texture& picture, Extent window) const {
    glViewport(0, 0, window.width, window.height);
    glUseProgram(program_.id());
    if (const gl::Uniform* extent = program_.reflection().find("extent"))
        gl::set_uniform(program_, *extent, std::array{double(window.width), double(window.height)});
    glBindSampler(0, 0);
    glBindTextureUnit(0, picture.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace tidemark::render
