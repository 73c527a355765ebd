// The numbers of a buffer as colours: under an exposure, one channel alone, or the difference of two. Reads a
// flat texture, draws bytes into one of its own.
#pragma once

#include "gl/render_target.hpp"
#include "render/filter_program.hpp"

#include <optional>
#include <vector>

namespace tidemark::render {

/// What of four numbers is seen, and how bright.
struct Look {
    std::optional<int> channel{}; ///< 0 to 3, in grey; none: red, green and blue as they are
    std::optional<int> less{};    ///< with `channel`: what is seen is channel - less, red above 0, blue below
    double stops = 0;             ///< of exposure: values are multiplied by 2 to the power of it
    bool automatic = false;       ///< instead: the largest magnitude that is seen comes to 1

    bool operator==(const Look&) const = default;
    /// What a screen shows of the numbers anyway.
    bool is_plain() const { return *this == Look{}; }
};

/// Lives in the context that it was made in.
class PictureLook {
public:
    static Result<PictureLook> create();

    /// A NaN is magenta and an infinity green where one is in what is seen. Null where there is no memory.
    const gl::Texture* draw(const gl::Texture& picture, const Look& look);
    /// The exposure of the last picture.
    double stops() const { return stops_; }

private:
    PictureLook(FilterProgram look, FilterProgram largest)
        : look_(std::move(look)), largest_(std::move(largest)) {}
    double automatic_stops(const gl::Texture& picture, const Look& look);

    FilterProgram look_;
    FilterProgram largest_;
    std::optional<gl::RenderTarget> target_{};
    std::vector<gl::RenderTarget> reduced_{}; ///< each of the largest values in blocks of the one before
    double stops_ = 0;
};

} // namespace tidemark::render
