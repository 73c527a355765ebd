#include "base/base64.hpp"

#include <cstdint>

namespace tidemark {

std::string base64(std::string_view bytes) {
    constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        const size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? uint32_t(static_cast<unsigned char>(bytes[i + k])) : 0U);
        for (size_t k = 0; k < 4; ++k)
            text += k <= count ? k_digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

} // namespace tidemark
