// A fragment shader over a whole framebuffer that reads one texture: for what lies over a scene's picture or
// shows it otherwise. Knows nothing of scenes.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"

#include <initializer_list>

namespace tidemark::render {

/// Lives in the context that it was made in.
class FilterProgram {
public:
    /// The text is complete, and has its texture, whose texels it gets as they are, at binding 0. `what`
    /// names the shader where the driver refuses it.
    static Result<FilterProgram> create(const char* what, const char* text);

    void set(const char* uniform, std::initializer_list<double> values) const;
    /// Over the lower left corner, that large, of the framebuffer that is bound.
    void draw(const gl::Texture& picture, Extent extent) const;

private:
    explicit FilterProgram(gl::Program program);

    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
    gl::SamplerHandle nearest_;
};

} // namespace tidemark::render
