// Shows the numbers of a buffer as colours: with an exposure, one channel alone, or the difference of two.
// Reads a flat texture, draws bytes into one of its own.
#pragma once

#include "gl/render_target.hpp"
#include "render/filter_program.hpp"

#include <optional>
#include <vector>

namespace tidemark::render {

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

} // namespace tidemark::render
