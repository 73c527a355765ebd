#include "image/noise.hpp"

#include <array>
#include <random>

namespace tidemark::image {
namespace {

constexpr int k_shift_x = 37;
constexpr int k_shift_y = 17;

using Plane = std::array<uint8_t, size_t{k_noise_side} * size_t{k_noise_side}>;

size_t texel(int x, int y) {
    return size_t(y % k_noise_side) * size_t{k_noise_side} + size_t(x % k_noise_side);
}

/// The engine's raw output is fixed by the standard; a std::uniform_int_distribution's is not.
Plane uniform_bytes(std::mt19937& random) {
    Plane plane;
    for (size_t i = 0; i < plane.size(); i += 4) {
        const auto word = uint32_t(random());
        for (size_t byte = 0; byte < 4; ++byte)
            plane[i + byte] = uint8_t(word >> (8 * byte));
    }
    return plane;
}

} // namespace

Image make_noise(uint32_t seed) {
    std::mt19937 random(seed);
    const Plane green = uniform_bytes(random);
    const Plane alpha = uniform_bytes(random);
    Image noise({k_noise_side, k_noise_side}, 4, SampleType::u8);
    for (int y = 0; y < k_noise_side; ++y) {
        for (int x = 0; x < k_noise_side; ++x) {
            const size_t here = texel(x, y);
            const size_t shifted = texel(x + k_shift_x, y + k_shift_y);
            uint8_t* pixel = &noise.u8()[4 * texel(x, k_noise_side - 1 - y)];
            pixel[0] = green[shifted];
            pixel[1] = green[here];
            pixel[2] = alpha[shifted];
            pixel[3] = alpha[here];
        }
    }
    return noise;
}

} // namespace tidemark::image
