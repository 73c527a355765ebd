// Marks over a picture: magenta for NaN, green for infinities, blue for negative values. Reads a texture of
// floats, draws into the window.
#pragma once

#include "render/filter_program.hpp"

namespace tidemark::render {

/// Valid in the context that created it.
class NumberMarks {
public:
    static Result<NumberMarks> create();

    /// Marks each pixel by the first of the three that occurs in one of its channels; leaves other pixels.
    /// The picture is stretched over the bound framebuffer, a window of that size.
    void draw(const gl::Texture& picture, Extent window) const;

private:
    explicit NumberMarks(FilterProgram program) : program_(std::move(program)) {}

    FilterProgram program_;
};

} // namespace tidemark::render
