#include "media/image.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace tidemark::image {
namespace {

template <class Sample>
bool last_channel_is(std::span<const Sample> samples, size_t channels, Sample value) {
    for (size_t i = channels - 1; i < samples.size(); i += channels)
        if (samples[i] != value)
            return false;
    return true;
}

/// Copies the first `kept` bytes of each pixel. Copies whole pixels, each overwriting the surplus of the
/// last: one move per pixel instead of one per sample.
template <size_t pixel, size_t kept>
void copy_front(const std::byte* from, size_t count, std::byte* to) {
    for (; count > 1; --count, from += pixel, to += kept)
        std::memcpy(to, from, pixel);
    if (count == 1)
        std::memcpy(to, from, kept);
}

} // namespace

Image flipped(const Image& image) {
    Image result(image.extent, image.channels, image.type);
    assert(result.bytes.size() == image.bytes.size());
    const size_t row = image.row_bytes();
    for (int y = 0; y < image.extent.height; ++y)
        std::copy_n(image.bytes.begin() + ptrdiff_t(row * size_t(y)), row,
                    result.bytes.begin() + ptrdiff_t(row * size_t(image.extent.height - 1 - y)));
    return result;
}

Image cropped(Image image, const Rectangle& area) {
    assert(area.within({0, 0, image.extent}) == area);
    const size_t pixel = size_t(image.channels) * size_of(image.type), row = image.row_bytes();
    image.extent = area.extent;
    const size_t kept = image.row_bytes();
    // A row moves towards the beginning, so it never overwrites a later one.
    for (size_t y = 0; y < size_t(area.extent.height); ++y)
        std::memmove(image.bytes.data() + y * kept,
                     image.bytes.data() + (size_t(area.y) + y) * row + size_t(area.x) * pixel, kept);
    image.bytes.resize(kept * size_t(area.extent.height));
    return image;
}

bool has_opaque_alpha(const Image& image) {
    if (!image.has_alpha())
        return false;
    const auto channels = size_t(image.channels);
    return image.type == SampleType::u8 ? last_channel_is<uint8_t>(image.u8(), channels, 255)
                                        : last_channel_is<float>(image.f32(), channels, 1.0f);
}

void copy_colours(const Image& image, int y, std::byte* to) {
    assert(image.has_alpha());
    const std::byte* from = image.bytes.data() + image.row_bytes() * size_t(y);
    const auto width = size_t(image.extent.width);
    switch (size_t(image.channels) * size_of(image.type)) {
    case 2: return copy_front<2, 1>(from, width, to);
    case 4: return copy_front<4, 3>(from, width, to);
    case 8: return copy_front<8, 4>(from, width, to);
    case 16: return copy_front<16, 12>(from, width, to);
    default: assert(false);
    }
}

Image without_alpha(const Image& image) {
    if (!image.has_alpha())
        return image;
    Image result(image.extent, image.channels - 1, image.type);
    for (int y = 0; y < image.extent.height; ++y)
        copy_colours(image, y, result.bytes.data() + result.row_bytes() * size_t(y));
    return result;
}

namespace {

enum class Kind { ordinary, nan, positive_infinity, negative_infinity, subnormal, beyond_half };

/// 65520, half way from the largest half to the next power of two, rounds to infinity.
constexpr uint32_t k_beyond_half = 0x477ff000u;

Kind kind_of(uint32_t bits) {
    const uint32_t exponent = bits & 0x7f800000u;
    const uint32_t fraction = bits & 0x007fffffu;
    if (exponent == 0)
        return fraction == 0 ? Kind::ordinary : Kind::subnormal;
    if (exponent != 0x7f800000u)
        return (bits & 0x7fffffffu) < k_beyond_half ? Kind::ordinary : Kind::beyond_half;
    if (fraction != 0)
        return Kind::nan;
    return (bits & 0x80000000u) == 0 ? Kind::positive_infinity : Kind::negative_infinity;
}

SamplePlace place_of(size_t sample, const Image& image) {
    const size_t pixel = sample / size_t(image.channels);
    return {int(pixel % size_t(image.extent.width)), int(pixel / size_t(image.extent.width)),
            int(sample % size_t(image.channels))};
}

size_t pixels_not_finite(const Image& image) {
    const auto channels = size_t(image.channels);
    const std::byte* from = image.bytes.data();
    size_t count = 0;
    for (size_t pixel = 0; pixel < image.extent.pixels(); ++pixel) {
        bool bad = false;
        for (size_t channel = 0; channel < channels; ++channel, from += sizeof(uint32_t)) {
            uint32_t bits;
            std::memcpy(&bits, from, sizeof bits);
            bad |= (bits & 0x7f800000u) == 0x7f800000u;
        }
        count += bad;
    }
    return count;
}

} // namespace

FiniteCensus census(const Image& image) {
    FiniteCensus result;
    result.samples = image.samples();
    if (image.type == SampleType::u8)
        return result;
    for (size_t i = 0; i < result.samples; ++i) {
        uint32_t bits;
        std::memcpy(&bits, image.bytes.data() + i * sizeof bits, sizeof bits);
        const Kind kind = kind_of(bits);
        if (kind == Kind::ordinary)
            continue;
        result.beyond_half += kind == Kind::beyond_half;
        if (kind == Kind::beyond_half)
            continue;
        result.nan += kind == Kind::nan;
        result.positive_infinity += kind == Kind::positive_infinity;
        result.negative_infinity += kind == Kind::negative_infinity;
        result.subnormal += kind == Kind::subnormal;
        auto& first = kind == Kind::subnormal ? result.first_subnormal : result.first_non_finite;
        if (!first)
            first = place_of(i, image);
    }
    return result;
}

size_t pixels_of_no_coverage(const Image& image) {
    assert(image.type == SampleType::f32 && image.has_alpha());
    const auto channels = size_t(image.channels);
    const std::span<const float> samples = image.f32();
    size_t count = 0;
    for (size_t i = channels - 1; i < samples.size(); i += channels)
        count += samples[i] < 0.0f || samples[i] > 1.0f;
    return count;
}

size_t take_non_finite(Image& image) {
    if (image.type != SampleType::u8)
        return pixels_not_finite(image);
    if (image.channels != 4)
        return 0;
    const std::span<uint8_t> samples = image.u8();
    size_t count = 0;
    for (size_t i = 3; i < samples.size(); i += 4)
        count += samples[i] == k_non_finite_alpha;
    for (size_t i = 3; count > 0 && i < samples.size(); i += 4) // rarely
        if (samples[i] == k_non_finite_alpha)
            samples[i] = 255;
    return count;
}

namespace {

constexpr size_t k_alpha = 3;

} // namespace

void LightMean::add(const Image& picture) {
    assert(picture.type == SampleType::f32 && picture.channels == 4);
    const auto samples = picture.f32();
    if (count_++ == 0)
        sums_.assign(samples.size(), 0);
    const auto shown = [&](double sample) {
        return clamped_ && std::isfinite(sample) ? std::clamp(sample, 0.0, 1.0) : sample;
    };
    for (size_t pixel = 0; pixel < samples.size(); pixel += 4) {
        const double alpha = shown(samples[pixel + k_alpha]);
        for (size_t i = pixel; i < pixel + k_alpha; ++i)
            sums_[i] += alpha * light_of_srgb(shown(samples[i]));
        sums_[pixel + k_alpha] += alpha;
    }
}

void LightMean::take(Image& mean) {
    const auto samples = mean.f32();
    for (size_t pixel = 0; pixel < samples.size(); pixel += 4) {
        const double alpha = sums_[pixel + k_alpha];
        for (size_t i = pixel; i < pixel + k_alpha; ++i)
            samples[i] = float(alpha == 0 && sums_[i] == 0 ? 0 : srgb_of_light(sums_[i] / alpha));
        samples[pixel + k_alpha] = float(alpha / count_);
    }
    count_ = 0;
}

} // namespace tidemark::image
