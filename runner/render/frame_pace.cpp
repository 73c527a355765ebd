#include "render/frame_pace.hpp"

namespace tidemark::render {
namespace {

/// Nobody notices that the window answers so late. A frame that waits for the screen at 24 Hz takes less.
constexpr double k_whole_seconds = 0.05;
/// Between the two it stays as it was.
constexpr double k_whole_again_seconds = 0.03;

} // namespace

FramePace::Way FramePace::way(Extent extent) const {
    if (!seconds_of_pixel_)
        return Way::in_parts;
    const double longest = last_ == Way::whole ? k_whole_seconds : k_whole_again_seconds;
    return *seconds_of_pixel_ * double(extent.pixels()) < longest ? Way::whole : Way::in_parts;
}

void FramePace::took(Extent extent, Way way, double seconds) {
    if (extent.pixels() == 0)
        return;
    seconds_of_pixel_ = seconds / double(extent.pixels());
    last_ = way;
}

} // namespace tidemark::render
