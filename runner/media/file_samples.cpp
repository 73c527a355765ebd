#include "media/file_samples.hpp"

#include "media/image.hpp"

#include <cassert>
#include <cstring>

namespace tidemark::image {
namespace {

/// Scales 0..1 to 0..`largest`, clamped and rounded to nearest; NaN gives 0.
template <class Integer>
Integer quantised(float value, double largest) {
    if (!(value > 0.0f))
        return 0;
    if (value >= 1.0f)
        return Integer(largest);
    return Integer(double(value) * largest + 0.5);
}

template <class To, class From, class Convert>
std::vector<std::byte> converted(std::span<const From> from, const Convert& convert) {
    std::vector<std::byte> bytes(from.size() * sizeof(To));
    To* to = reinterpret_cast<To*>(bytes.data());
    for (size_t i = 0; i < from.size(); ++i)
        to[i] = convert(from[i]);
    return bytes;
}

std::vector<std::byte> from_u8(const Image& image, SampleDepth depth) {
    switch (depth) {
    case SampleDepth::u8: return image.bytes;
    case SampleDepth::u16:
        return converted<uint16_t>(image.u8(), [](uint8_t v) { return uint16_t(v * 257); });
    case SampleDepth::half:
    case SampleDepth::f32: return converted<float>(image.u8(), [](uint8_t v) { return float(v) / 255.0f; });
    }
    return {};
}

std::vector<std::byte> from_f32(const Image& image, SampleDepth depth) {
    switch (depth) {
    case SampleDepth::u8:
        return converted<uint8_t>(image.f32(), [](float v) { return quantised<uint8_t>(v, 255.0); });
    case SampleDepth::u16:
        return converted<uint16_t>(image.f32(), [](float v) { return quantised<uint16_t>(v, 65535.0); });
    case SampleDepth::half:
    case SampleDepth::f32: return image.bytes;
    }
    return {};
}

/// Converts a picture to floats and each colour to `becomes(colour, alpha)`.
template <class Becomes>
Image with_colours(const Image& image, const Becomes& becomes) {
    Image result = in_floats(image);
    const auto channels = size_t(result.channels);
    const size_t colours = channels - (result.has_alpha() ? 1 : 0);
    const std::span<float> samples = result.f32();
    for (size_t pixel = 0; pixel < samples.size(); pixel += channels) {
        const float alpha = result.has_alpha() ? samples[pixel + colours] : 1.0f;
        for (float& sample : samples.subspan(pixel, colours))
            sample = becomes(sample, alpha);
    }
    return result;
}

} // namespace

std::vector<std::byte> file_samples(const Image& image, SampleDepth depth) {
    return image.type == SampleType::u8 ? from_u8(image, depth) : from_f32(image, depth);
}

Image in_bytes(Image image) {
    if (image.type == SampleType::u8)
        return image;
    Image bytes;
    bytes.extent = image.extent;
    bytes.channels = image.channels;
    bytes.bytes = file_samples(image, SampleDepth::u8);
    return bytes;
}

Image in_floats(Image image) {
    if (image.type == SampleType::f32)
        return image;
    Image floats;
    floats.extent = image.extent;
    floats.channels = image.channels;
    floats.type = SampleType::f32;
    floats.bytes = file_samples(image, SampleDepth::f32);
    return floats;
}

namespace {

template <class Sample>
void spread(std::span<const Sample> from, int from_channels, std::span<Sample> to, int channels, Sample one) {
    const bool grey = from_channels < 3, alpha = from_channels % 2 == 0;
    const int colours = channels >= 3 ? 3 : 1;
    for (size_t pixel = 0; pixel < to.size() / size_t(channels); ++pixel) {
        const Sample* source = &from[pixel * size_t(from_channels)];
        Sample* target = &to[pixel * size_t(channels)];
        for (int i = 0; i < colours; ++i)
            target[i] = source[grey ? 0 : i];
        if (channels > colours)
            target[colours] = alpha ? source[from_channels - 1] : one;
    }
}

} // namespace

Image with_channels(const Image& image, int channels) {
    if (image.channels == channels)
        return image;
    assert(image.channels < channels && !(image.has_alpha() && channels == 3));
    Image result(image.extent, channels, image.type);
    if (image.type == SampleType::u8)
        spread<uint8_t>(image.u8(), image.channels, result.u8(), channels, 255);
    else
        spread<float>(image.f32(), image.channels, result.f32(), channels, 1.0F);
    return result;
}

Image in_light(const Image& image) {
    return with_colours(image, [](float colour, float) { return float(light_of_srgb(colour)); });
}

Image premultiplied(const Image& image) {
    return with_colours(image, [](float colour, float alpha) { return colour * alpha; });
}

Image radiance_samples(const Image& image) {
    const Image colour = without_alpha(image);
    const std::vector<std::byte> floats = file_samples(colour, SampleDepth::f32);
    const auto channels = size_t(colour.channels);
    constexpr float largest = 0x1.fep126f; // mantissa 255/256, exponent byte 255
    Image result(image.extent, 3, SampleType::f32);
    for (size_t i = 0; i < result.samples(); ++i) {
        float value;
        const size_t source = channels == 3 ? i : i / 3;
        std::memcpy(&value, floats.data() + source * sizeof value, sizeof value);
        result.f32()[i] = value > 0.0f ? (value < largest ? value : largest) : 0.0f;
    }
    return result;
}

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
