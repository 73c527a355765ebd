#include "image/files/video_planes.hpp"

#include "image/files/file_samples.hpp"

#include <cassert>

namespace tidemark::image {
namespace {

/// BT.709-6, 3.2 and 3.3. The divisors are twice (1 - weight) of blue and red.
constexpr double k_red = 0.2126, k_green = 0.7152, k_blue = 0.0722;
constexpr double k_blue_difference = 2 * (1 - k_blue), k_red_difference = 2 * (1 - k_red);

uint16_t rounded(double code) {
    return uint16_t(code + 0.5);
}

/// Rounds a sample to 16 bits, clamped to 0..1; NaN gives 0.
double shown(float sample) {
    constexpr double k_largest = 65535;
    return sample > 0.0f ? (sample < 1.0f ? rounded(k_largest * double(sample)) / k_largest : 1.0) : 0.0;
}

} // namespace

std::vector<uint16_t> ten_bit_planes(const Image& image, bool alpha) {
    assert(image.channels == 4);
    if (image.type != SampleType::f32)
        return ten_bit_planes(in_floats(image), alpha);
    const size_t plane = image.extent.pixels();
    const auto width = size_t(image.extent.width);
    std::vector<uint16_t> planes((alpha ? 4 : 3) * plane);
    const float* pixel = image.f32().data();
    for (auto row = size_t(image.extent.height); row-- > 0;) {
        uint16_t* const to = &planes[row * width];
        for (size_t x = 0; x < width; ++x, pixel += 4) {
            const double red = shown(pixel[0]), green = shown(pixel[1]), blue = shown(pixel[2]);
            const double luma = k_red * red + k_green * green + k_blue * blue;
            to[x] = rounded(64 + 876 * luma);
            to[x + plane] = rounded(512 + 896 / k_blue_difference * (blue - luma));
            to[x + 2 * plane] = rounded(512 + 896 / k_red_difference * (red - luma));
            if (alpha)
                to[x + 3 * plane] = rounded(1023 * shown(pixel[3]));
        }
    }
    return planes;
}

} // namespace tidemark::image
