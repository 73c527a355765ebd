// Marks over a picture where its values are no numbers or below zero: a NaN is magenta, an infinity green, a
// negative value blue. Reads a texture of floats, draws into the window.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "gl/texture.hpp"

namespace tidemark::render {

/// Lives in the context that it was made in.
class NumberMarks {
public:
    static Result<NumberMarks> create();

    /// The first of the three that one of a pixel's channels is. Stretched over the framebuffer of a window
    /// of that size, which is bound; other pixels stay.
    void draw(const gl::Texture& picture, Extent window) const;

private:
    NumberMarks(gl::Program program, gl::VertexArrayHandle no_vertices)
        : program_(std::move(program)), no_vertices_(std::move(no_vertices)) {}

    gl::Program program_;
    gl::VertexArrayHandle no_vertices_;
};

} // namespace tidemark::render
