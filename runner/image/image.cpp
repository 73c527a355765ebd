#include "image/image.hpp"

#include <algorithm>
#include <cassert>
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

template <class Sample>
void copy_but_last_channel(std::span<const Sample> from, size_t channels, std::span<Sample> to) {
    const size_t kept = channels - 1;
    const size_t pixels = from.size() / channels;
    for (size_t pixel = 0; pixel < pixels; ++pixel)
        for (size_t channel = 0; channel < kept; ++channel)
            // As bytes: a float that is assigned may lose the payload of a signalling NaN.
            std::memcpy(&to[pixel * kept + channel], &from[pixel * channels + channel], sizeof(Sample));
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

bool has_opaque_alpha(const Image& image) {
    if (!image.has_alpha())
        return false;
    const auto channels = size_t(image.channels);
    return image.type == SampleType::u8 ? last_channel_is<uint8_t>(image.u8(), channels, 255)
                                        : last_channel_is<float>(image.f32(), channels, 1.0f);
}

Image without_alpha(const Image& image) {
    if (!image.has_alpha())
        return image;
    Image result(image.extent, image.channels - 1, image.type);
    if (image.type == SampleType::u8)
        copy_but_last_channel<uint8_t>(image.u8(), size_t(image.channels), result.u8());
    else
        copy_but_last_channel<float>(image.f32(), size_t(image.channels), result.f32());
    return result;
}

} // namespace tidemark::image
