// Views of buffers: flat pictures, marks, exposure, floats of the shown pass.
//
// Draws a fragment shader over a whole framebuffer, reading one texture: for overlays and other views of a
// scene's picture. Independent of scenes.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"
#include "render/renderer.hpp"

#include <initializer_list>
#include <optional>
#include <vector>

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

// Shows a cube or a volume as a flat picture: the six faces unfolded, or one slice. Reads a texture and draws
// into one of its own; values stay unchanged.

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

// Marks over a picture: magenta for NaN, green for infinities, blue for negative values. Reads a texture of
// floats, draws into the window.

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

// Shows the numbers of a buffer as colours: with an exposure, one channel alone, or the difference of two.
// Reads a flat texture, draws bytes into one of its own.

/// Which of the four channels are shown, and how bright.
struct Look {
    std::optional<int> channel{}; ///< 0 to 3, in grey; none: red, green and blue
    std::optional<int> less{};    ///< with `channel`: shows channel - less, red above 0, blue below
    double stops = 0;             ///< exposure: values are multiplied by 2^stops
    bool automatic = false;       ///< instead of `stops`: the largest shown magnitude becomes 1

    bool operator==(const Look&) const = default;
    /// Returns whether the look changes nothing.
    bool is_plain() const { return *this == Look{}; }
};

/// Valid in the context that created it.
class PictureLook {
public:
    static Result<PictureLook> create();

    /// Draws the picture. Pixels whose shown channels contain a NaN are magenta, an infinity green. Returns
    /// null when there is no memory.
    const gl::Texture* draw(const gl::Texture& picture, const Look& look);
    /// Returns the exposure of the last picture.
    double stops() const { return stops_; }

private:
    PictureLook(FilterProgram look, FilterProgram largest)
        : look_(std::move(look)), largest_(std::move(largest)) {}
    double automatic_stops(const gl::Texture& picture, const Look& look);

    FilterProgram look_;
    FilterProgram largest_;
    std::optional<gl::RenderTarget> target_{};
    std::vector<gl::RenderTarget> reduced_{}; ///< each holds the largest values in blocks of the one before
    double stops_ = 0;
};

// Redraws parts of the shown pass as floats on demand, because a window keeps Image in bytes. Draws no other
// pass.

/// Belongs to one renderer and its context.
class ShownFloats {
public:
    /// Returns a texture whose pixels within `part` are those of the frame on show, drawn from `inputs`. If
    /// the pass cannot be drawn again, or there is no memory, returns the picture in bytes.
    const gl::Texture& draw(const Renderer& renderer, const FrameInputs& inputs, const Rectangle& part);

private:
    bool has_target(const Renderer& renderer);

    std::optional<bool> can_draw_again_{}; ///< empty: not checked yet
    std::optional<gl::RenderTarget> target_{};
};

} // namespace tidemark::render
