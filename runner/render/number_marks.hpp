// Marks over a picture where its values are no numbers or below zero: a NaN is magenta, an infinity green, a
// negative value blue. Reads a texture of floats, draws into the window.
#pragma once

#include "render/filter_program.hpp"

namespace tidemark::render {

/// Lives in the context that it was made in.
class NumberMarks {
public:
    static Result<NumberMarks> create();

    /// The first of the three that one of a pixel's channels is. Stretched over the framebuffer of a window
    /// of that size, which is bound; other pixels stay.
    void draw(const gl::Texture& picture, Extent window) const;

private:
    explicit NumberMarks(FilterProgram program) : program_(std::move(program)) {}

    FilterProgram program_;
};

} // namespace tidemark::render
