#include "cli/capture/loop_check.hpp"

#include "image/compare/metrics.hpp"

#include <fmt/format.h>

namespace tidemark::cli {

int frame_behind(const std::vector<int>& frames) {
    const int last = frames.back();
    return frames.size() > 1 ? 2 * last - frames[frames.size() - 2] : last + 1;
}

void LoopCheck::see(const image::Image& picture) {
    if (++seen_ == 1) {
        first_ = picture;
        return;
    }
    closing_ = image::compare(first_, picture)->psnr;
    if (seen_ == 2)
        step_ = closing_;
}

std::string LoopCheck::words() const {
    return fmt::format(
        "loop: the frame behind the last is the first to {:.1f} dB (the second is it to {:.1f}): {}",
        closing_, step_, closing_ >= step_ ? "it goes round" : "it jumps where it begins again");
}

} // namespace tidemark::cli
