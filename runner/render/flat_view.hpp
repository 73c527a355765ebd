// A cube or a volume as a flat picture: six faces unfolded, or one slice. Reads a texture, draws into one of
// its own; values stay what they are.
#pragma once

#include "gl/render_target.hpp"
#include "render/filter_program.hpp"

#include <optional>

namespace tidemark::render {

/// Of one texture, in the context that it was made in.
class FlatView {
public:
    static bool is_needed(const gl::Texture& picture) { return picture.target != GL_TEXTURE_2D; }
    static Result<FlatView> create(const gl::Texture& picture);

    /// Of a volume that slice, pixel for pixel. Of a cube its faces in a cross of four by three, +z in the
    /// middle between -x and +x, -z on the right, +y above; each in so many pixels a side at most; zero
    /// beside them. Null where there is no memory for it.
    const gl::Texture* draw(const gl::Texture& picture, int slice, int most_of_a_side);

private:
    explicit FlatView(FilterProgram program) : program_(std::move(program)) {}

    FilterProgram program_;
    std::optional<gl::RenderTarget> target_{};
};

} // namespace tidemark::render
