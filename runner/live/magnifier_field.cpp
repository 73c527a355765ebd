#include "live/magnifier_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tidemark::live {

std::string number_text(float value) {
    if (std::isnan(value))
        return "NaN";
    if (std::isinf(value))
        return value < 0 ? "-Inf" : "Inf";
    return fmt::format("{:.7g}", value);
}

std::string bits_text(float value) {
    return fmt::format("{:#010x}", std::bit_cast<uint32_t>(value));
}

MagnifierField::Colour colour_of(const float* rgb) {
    MagnifierField::Colour colour;
    for (size_t i = 0; i < colour.size(); ++i) {
        const float value = std::isnan(rgb[i]) ? 0 : std::clamp(rgb[i], 0.0F, 1.0F);
        colour[i] = static_cast<unsigned char>(std::lround(value * 255));
    }
    return colour;
}

} // namespace tidemark::live
