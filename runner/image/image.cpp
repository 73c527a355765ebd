#include "image/image.hpp"

#include "image/colours.hpp"

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

} // namespace tidemark::image
