#include "image/files/video_planes.hpp"

#include "image/files/file_samples.hpp"

#include <array>
#include <cassert>

namespace tidemark::image {
namespace {

/// BT.709-6, 3.2 and 3.3; twice what blue and red lack of luma.
constexpr double k_red = 0.2126, k_green = 0.7152, k_blue = 0.0722;
constexpr double k_blue_difference = 2 * (1 - k_blue), k_red_difference = 2 * (1 - k_red);

/// NaN fails both comparisons.
double shown(float sample) {
    return sample > 0.0f ? (sample < 1.0f ? double(sample) : 1.0) : 0.0;
}

uint16_t rounded(double code) {
    return uint16_t(code + 0.5);
}

std::array<uint16_t, 4> codes_of(const float* pixel) {
    const double red = shown(pixel[0]), green = shown(pixel[1]), blue = shown(pixel[2]);
    const double luma = k_red * red + k_green * green + k_blue * blue;
    return {rounded(64 + 876 * luma), rounded(512 + 896 * (blue - luma) / k_blue_difference),
            rounded(512 + 896 * (red - luma) / k_red_difference), rounded(1023 * shown(pixel[3]))};
}

} // namespace

std::vector<std::byte> ten_bit_planes(const Image& image, bool alpha) {
    assert(image.channels == 4);
    const Image floats = in_floats(image);
    const size_t plane = image.extent.pixels(), planes = alpha ? 4 : 3;
    const auto width = size_t(image.extent.width);
    std::vector<std::byte> bytes(2 * planes * plane);
    const float* pixel = floats.f32().data();
    for (size_t row = size_t(image.extent.height); row-- > 0;)
        for (size_t x = 0; x < width; ++x, pixel += 4) {
            const std::array<uint16_t, 4> codes = codes_of(pixel);
            for (size_t i = 0; i < planes; ++i) {
                std::byte* to = &bytes[2 * (i * plane + row * width + x)];
                to[0] = std::byte(codes[i] & 0xff);
                to[1] = std::byte(codes[i] >> 8);
            }
        }
    return bytes;
}

} // namespace tidemark::image
