// The pixel under the pointer and those around it, as the magnifier shows them. Reads no picture.
#pragma once

#include "base/extent.hpp"
#include "platform/input.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::live {

/// What a pass wrote into a pixel.
struct PixelValue {
    std::string pass;
    std::vector<float> channels; ///< three of Image, whose alpha nobody sees; else four
};

struct MagnifierField {
    using Colour = std::array<unsigned char, 3>;

    platform::PointerPosition pointer{};          ///< on the window
    int x = 0;                                    ///< of the picture, from the left
    int y = 0;                                    ///< from the bottom
    Extent cells{};                               ///< odd: that pixel is in the middle
    std::vector<std::optional<Colour>> colours{}; ///< bottom row first; none beyond the picture's edge
    std::vector<PixelValue> values{};             ///< the pass that is looked at in front
};

/// Seven digits at most, so that columns stay where they are; `NaN`, `Inf`, `-Inf`.
std::string number_text(float value);
/// All of its bits, as in `0x3f800000`.
std::string bits_text(float value);

/// As a screen shows it, which has no more than bytes.
MagnifierField::Colour colour_of(const float* rgb);

} // namespace tidemark::live
