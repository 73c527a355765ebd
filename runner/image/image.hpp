// A picture in memory: plain samples, independent of files and GL. Rows run from the bottom to the top, as in
// OpenGL.
#pragma once

#include "base/extent.hpp"

#include <cstddef>
#include <cstdint>
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

/// Returns whether the picture has an alpha channel that is 1 in every pixel.
bool has_opaque_alpha(const Image& image);

/// Returns the picture without its alpha channel; an unchanged copy when it has none.
Image without_alpha(const Image& image);

} // namespace tidemark::image
