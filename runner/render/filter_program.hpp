// Draws a fragment shader over a whole framebuffer, reading one texture: for overlays and other views of a
// scene's picture. Independent of scenes.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"

#include <initializer_list>

namespace tidemark::render {

/// Valid in the context that created it.
class FilterProgram {
public:
    /// `text` is a complete shader with its texture at binding 0, sampled without filtering. `what` names the
    /// shader in the driver's error.
    static Result<FilterProgram> create(const char* what, const char* text);

    void set(const char* uniform, std::initializer_list<double> values) const;
    /// Draws over the bottom left corner, of that size, of the bound framebuffer.
    void draw(const gl::Texture& picture, Extent extent) const;

private:
    explicit FilterProgram(gl::Program program);

    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
    gl::SamplerHandle nearest_;
};

} // namespace tidemark::render
