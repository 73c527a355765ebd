#include "image/census.hpp"

#include <cassert>
#include <cstring>

namespace tidemark::image {
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

} // namespace tidemark::image
