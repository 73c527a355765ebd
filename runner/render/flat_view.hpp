// Shows a cube or a volume as a flat picture: the six faces unfolded, or one slice. Reads a texture and draws
// into one of its own; values stay unchanged.
#pragma once

#include "gl/render_target.hpp"
#include "render/filter_program.hpp"

#include <optional>

namespace tidemark::render {

/// View of one texture, valid in the context that created it.
class FlatView {
public:
    static bool is_needed(const gl::Texture& picture) { return picture.target != GL_TEXTURE_2D; }
    static Result<FlatView> create(const gl::Texture& picture);

    /// Draws that slice of a volume, pixel for pixel; or the faces of a cube as a cross of four by three, +z
    /// in the middle between -x and +x, -z on the right, +y above, each face with at most `most_of_a_side`
    /// pixels a side, and zero outside the cross. Returns null when there is no memory for it.
    const gl::Texture* draw(const gl::Texture& picture, int slice, int most_of_a_side);

private:
    explicit FlatView(FilterProgram program) : program_(std::move(program)) {}

    FilterProgram program_;
    std::optional<gl::RenderTarget> target_{};
};

} // namespace tidemark::render
