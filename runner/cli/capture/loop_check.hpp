// Whether a sequence goes round: the frame behind its last is held against its first, beside what one frame's
// step is elsewhere.
#pragma once

#include "image/image.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// The frame that would come next.
int frame_behind(const std::vector<int>& frames);

class LoopCheck {
public:
    /// Every frame of the sequence, in its order, and the one behind it.
    void see(const image::Image& picture);

    /// What the last one that was seen is to the first, and the second to it; PSNR, dB.
    double closing() const { return closing_; }
    double step() const { return step_; }
    std::string words() const;

private:
    image::Image first_;
    size_t seen_ = 0;
    double step_ = 0, closing_ = 0;
};

} // namespace tidemark::cli
