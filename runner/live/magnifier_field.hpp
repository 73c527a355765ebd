// The pixel under the pointer and those around it, as the magnifier shows them. Reads no picture.
#pragma once

#include "base/extent.hpp"
#include "platform/input.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::live {

/// The value that a pass wrote into a pixel.
struct PixelValue {
    std::string pass;
    std::vector<float> channels; ///< three for Image, whose alpha is not shown; else four
};

struct MagnifierField {
    using Colour = std::array<unsigned char, 3>;

    platform::PointerPosition pointer{};          ///< in the window
    int x = 0;                                    ///< in the picture, from the left
    int y = 0;                                    ///< from the bottom
    Extent cells{};                               ///< odd sizes: pixel x,y is in the middle
    std::vector<std::optional<Colour>> colours{}; ///< bottom row first; none beyond the picture's edge
    std::vector<PixelValue> values{};             ///< the shown pass first
};

/// Formats a value with at most seven digits, so that columns stay aligned; `NaN`, `Inf`, `-Inf`.
std::string number_text(float value);
/// Formats all bits of a value, as in `0x3f800000`.
std::string bits_text(float value);

/// Converts a colour to bytes: clamped to 0..1, NaN as 0.
MagnifierField::Colour colour_of(const float* rgb);

} // namespace tidemark::live
