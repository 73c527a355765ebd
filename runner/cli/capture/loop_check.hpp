// Checks whether a sequence is a seamless loop: compares the frame after the last with the first, and for
// scale the second with the first.
#pragma once

#include "image/image.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Returns the frame that would come next.
int frame_behind(const std::vector<int>& frames);

class LoopCheck {
public:
    /// Adds a frame; call it for each one in order, and for the frame after the last.
    void see(const image::Image& picture);

    /// PSNR in dB of the latest frame against the first, and of the second against the first.
    double closing() const { return closing_; }
    double step() const { return step_; }
    std::string words() const;

private:
    image::Image first_;
    size_t seen_ = 0;
    double step_ = 0, closing_ = 0;
};

} // namespace tidemark::cli
