#include "render/filter_program.hpp"

#include "glsl/assemble.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

namespace tidemark::render {

Result<FilterProgram> FilterProgram::create(const char* what, const char* text) {
    auto program = gl::Program::link(glsl::k_vertex_shader, text);
    if (!program)
        return fail(ErrorCode::load,
                    fmt::format("the driver refuses the shader of {}: {}", what, program.error()));
    return FilterProgram(*std::move(program));
}

FilterProgram::FilterProgram(gl::Program program)
    : program_(std::move(program)), nearest_(gl::make_sampler(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE)) {
    GLuint vertex_array = 0;
    glCreateVertexArrays(1, &vertex_array);
    no_vertices_ = gl::VertexArrayHandle(vertex_array);
}

void FilterProgram::set(const char* uniform, std::initializer_list<double> values) const {
    if (const gl::Uniform* found = program_.reflection().find(uniform))
        gl::set_uniform(program_, *found, std::span(values.begin(), values.size()));
}

void FilterProgram::draw(const gl::Texture& picture, Extent extent) const {
    glViewport(0, 0, extent.width, extent.height);
    glUseProgram(program_.id());
    glBindSampler(0, nearest_.id());
    glBindTextureUnit(0, picture.id());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace tidemark::render
