#include "render/frame_pace.hpp"

namespace tidemark::render {
namespace {

/// Too short a delay to be noticed. A frame that waits for the screen at 24 Hz takes less.
constexpr double k_whole_seconds = 0.05;
/// Between the two limits the way stays the same.
constexpr double k_whole_again_seconds = 0.03;

} // namespace

std::optional<double> FramePace::expected(Extent extent) const {
    return seconds_of_pixel_ ? std::optional(*seconds_of_pixel_ * double(extent.pixels())) : std::nullopt;
}

FramePace::Way FramePace::way(Extent extent) const {
    const double longest = last_ == Way::whole ? k_whole_seconds : k_whole_again_seconds;
    return expected(extent).value_or(longest) < longest ? Way::whole : Way::in_parts;
}

void FramePace::took(Extent extent, Way way, double seconds) {
    if (extent.pixels() == 0)
        return;
    seconds_of_pixel_ = seconds / double(extent.pixels());
    last_ = way;
}

} // namespace tidemark::render
