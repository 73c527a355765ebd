// A picture in memory: plain samples, independent of files and GL. Rows run from the bottom to the top, as in
// OpenGL.
#pragma once

#include "base/extent.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tidemark::image {

enum class SampleType {
    u8,  ///< 0..255 stands for 0..1
    f32, ///< IEEE binary32, any value, NaN and infinities kept
};

constexpr size_t size_of(SampleType type) {
    return type == SampleType::u8 ? 1 : 4;
}

/// Interleaved samples, `channels` per pixel: grey, grey and alpha, RGB or RGBA; row 0 is the bottom row;
/// rows are not padded.
struct Image {
    Extent extent;
    int channels = 4;
    SampleType type = SampleType::u8;
    std::vector<std::byte> bytes;

    Image() = default;
    Image(Extent size, int channel_count, SampleType sample_type)
        : extent(size), channels(channel_count), type(sample_type),
          bytes(size.pixels() * size_t(channel_count) * size_of(sample_type)) {}
    Image(Extent size, int channel_count, SampleType sample_type, std::vector<std::byte> its_bytes)
        : extent(size), channels(channel_count), type(sample_type), bytes(std::move(its_bytes)) {}

    size_t samples() const { return extent.pixels() * size_t(channels); }
    size_t row_bytes() const { return size_t(extent.width) * size_t(channels) * size_of(type); }
    bool has_alpha() const { return channels == 2 || channels == 4; }

    std::span<uint8_t> u8() { return {reinterpret_cast<uint8_t*>(bytes.data()), samples()}; }
    std::span<const uint8_t> u8() const {
        return {reinterpret_cast<const uint8_t*>(bytes.data()), samples()};
    }
    std::span<float> f32() { return {reinterpret_cast<float*>(bytes.data()), samples()}; }
    std::span<const float> f32() const { return {reinterpret_cast<const float*>(bytes.data()), samples()}; }

    bool operator==(const Image&) const = default;
};

/// Returns the picture upside down.
Image flipped(const Image& image);

/// Returns the part of the picture that `area` covers, which must lie inside; in the same memory.
Image cropped(Image image, const Rectangle& area);

/// Returns whether the picture has an alpha channel that is 1 in every pixel.
bool has_opaque_alpha(const Image& image);

/// Returns the picture without its alpha channel; an unchanged copy when it has none.
Image without_alpha(const Image& image);

// The transfer function of sRGB (IEC 61966-2-1) between a sample and linear light. It continues below 0 and
// above 1 as in scRGB: odd about 0 and unbounded.

/// Meaning of the samples of a file. Colours have BT.709's primaries and white.
enum class Transfer {
    data,  ///< numbers without colour, such as a buffer's state
    srgb,  ///< display values, as ShaderToy's Image writes them
    linear ///< linear light
};

/// Decodes a sample. The error is that of two roundings and of pow.
inline double light_of_srgb(double sample) {
    const double size = std::abs(sample);
    return std::copysign(size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4), sample);
}

inline double srgb_of_light(double light) {
    const double size = std::abs(light);
    return std::copysign(size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055, light);
}

// Copies the samples of a picture without its alpha.

/// Copies the colours of row `y`, bit by bit. The image must have alpha.
void copy_colours(const Image& image, int y, std::byte* to);

// Counts the samples of a picture that are not ordinary numbers, and locates the first. Tests bits, so that
// neither compiler flags nor flush to zero change the result.

/// One sample: column, row from the bottom, channel.
struct SamplePlace {
    int x = 0;
    int y = 0;
    int channel = 0;

    bool operator==(const SamplePlace&) const = default;
};

/// Counts of samples. "First" is in memory order: the bottom row first, from left to right.
struct FiniteCensus {
    size_t samples = 0;
    size_t nan = 0;
    size_t positive_infinity = 0;
    size_t negative_infinity = 0;
    size_t subnormal = 0;
    size_t beyond_half = 0; ///< finite, but an infinity when it is rounded to a half
    std::optional<SamplePlace> first_non_finite{};
    std::optional<SamplePlace> first_subnormal{};

    size_t non_finite() const { return nan + positive_infinity + negative_infinity; }
    bool operator==(const FiniteCensus&) const = default;
};

FiniteCensus census(const Image& image);

/// Counts the pixels of a picture of floats whose alpha is below 0 or above 1. Ignores NaN.
size_t pixels_of_no_coverage(const Image& image);

/// Alpha of a byte pixel whose value was NaN or infinite when drawn, because bytes cannot hold these.
inline constexpr uint8_t k_non_finite_alpha = 51;

/// Counts the pixels with a NaN or an infinity: floats by their bits, bytes by k_non_finite_alpha, which it
/// sets to 1.
size_t take_non_finite(Image& image);

// Averages pictures in linear light, as the eye or a film does: samples are taken as sRGB, decoded, added and
// encoded again. Colours are weighted by their straight alpha; a pixel with alpha 0 in all pictures is black.

/// Mean of RGBA pictures in floats. A pixel that is NaN or infinite in one of them is so in the mean.
class LightMean {
public:
    /// `clamped`: colours beyond 0 to 1 count as displayed.
    explicit LightMean(bool clamped) : clamped_(clamped) {}

    /// Adds a picture, of the same size as those before.
    void add(const Image& picture);
    /// Writes the mean of the added pictures into `mean` and starts again.
    void take(Image& mean);

private:
    bool clamped_;
    int count_ = 0;
    std::vector<double> sums_;
};

} // namespace tidemark::image
