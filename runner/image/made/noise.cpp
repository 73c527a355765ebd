#include "image/made/noise.hpp"

#include "image/made/void_and_cluster.hpp"

#include <array>
#include <cassert>
#include <random>

namespace tidemark::image {
namespace {

constexpr int k_shift_x = 37;
constexpr int k_shift_y = 17;

/// Separate random streams, so that grey noise differs from the green of the RGBA noise.
enum class Stream : uint32_t { grey_256 = 1, grey_64, rgba_64, blue, volume };

std::mt19937 random_of(Stream stream, uint32_t seed) {
    std::seed_seq seeds{seed, uint32_t(stream)};
    return std::mt19937(seeds);
}

constexpr size_t k_noise_texels = size_t{k_noise_side} * size_t{k_noise_side};

size_t texel(int x, int y) {
    return size_t(y % k_noise_side) * size_t{k_noise_side} + size_t(x % k_noise_side);
}

/// Returns uniform bytes from the engine's raw output, which the standard fixes, unlike that of
/// std::uniform_int_distribution.
std::vector<uint8_t> uniform_bytes(std::mt19937& random, size_t count) {
    assert(count % 4 == 0);
    std::vector<uint8_t> bytes(count);
    for (size_t i = 0; i < count; i += 4) {
        const auto word = uint32_t(random());
        for (size_t byte = 0; byte < 4; ++byte)
            bytes[i + byte] = uint8_t(word >> (8 * byte));
    }
    return bytes;
}

/// Draws a picture by `sample(x, y, channel)`, with y from the top, as in a file.
template <class Sample>
Image draw(int side, int channels, const Sample& sample) {
    Image image({side, side}, channels, SampleType::u8);
    size_t next = 0;
    for (int y = side; y-- > 0;)
        for (int x = 0; x < side; ++x)
            for (int channel = 0; channel < channels; ++channel)
                image.u8()[next++] = sample(x, y, channel);
    return image;
}

Image make_grey(int side, std::mt19937 random) {
    const std::vector<uint8_t> bytes = uniform_bytes(random, size_t(side) * size_t(side));
    return draw(side, 1, [&](int x, int y, int) { return bytes[size_t(y * side + x)]; });
}

Image make_small_rgba(uint32_t seed) {
    constexpr size_t side = 64, texels = side * side;
    std::mt19937 random = random_of(Stream::rgba_64, seed);
    const std::vector<uint8_t> planes = uniform_bytes(random, 3 * texels);
    return draw(side, 4, [&](int x, int y, int channel) {
        const size_t here = size_t(y) * side + size_t(x);
        return channel < 3 ? planes[size_t(channel) * texels + here]
                           : planes[2 * texels + (here + 1) % texels];
    });
}

Image make_blue(uint32_t seed) {
    std::mt19937 random = random_of(Stream::blue, seed);
    std::array<std::vector<uint8_t>, 4> masks;
    for (std::vector<uint8_t>& mask : masks)
        mask = make_blue_mask(random);
    return draw(1024, 4, [&](int x, int y, int channel) {
        return masks[size_t(channel)][size_t(y % k_blue_side * k_blue_side + x % k_blue_side)];
    });
}

/// Returns a level of B. E. Bayer's pattern (1973): the order of a texel interleaves the bits of x xor y and
/// of y, the lowest first.
uint8_t bayer_level(int x, int y) {
    int order = 0;
    for (int bit = 0; bit < 3; ++bit) {
        order = 4 * order + 2 * (((x ^ y) >> bit) & 1) + ((y >> bit) & 1);
    }
    return uint8_t(4 * order + 2);
}

} // namespace

Image make_noise(uint32_t seed) {
    std::mt19937 random(seed);
    const std::vector<uint8_t> green = uniform_bytes(random, k_noise_texels);
    const std::vector<uint8_t> alpha = uniform_bytes(random, k_noise_texels);
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

Image make_noise(NoiseTexture kind, uint32_t seed) {
    switch (kind) {
    case NoiseTexture::rgba_256: return make_noise(seed);
    case NoiseTexture::rgba_64: return make_small_rgba(seed);
    case NoiseTexture::grey_256: return make_grey(256, random_of(Stream::grey_256, seed));
    case NoiseTexture::grey_64: return make_grey(64, random_of(Stream::grey_64, seed));
    case NoiseTexture::blue_1024: return make_blue(seed);
    case NoiseTexture::bayer_8: return draw(8, 1, [](int x, int y, int) { return bayer_level(x, y); });
    }
    assert(false);
    return {};
}

VolumeData make_noise_volume(NoiseVolume kind, uint32_t seed) {
    constexpr int side = 32;
    VolumeData volume{side, side, side, kind == NoiseVolume::grey_32 ? 1 : 4, SampleType::u8};
    std::mt19937 random = random_of(Stream::volume, seed);
    for (const uint8_t byte : uniform_bytes(random, volume.samples()))
        volume.bytes.push_back(std::byte(byte));
    return volume;
}

} // namespace tidemark::image
