// Helpers of the picture tests: a folder of their own, pictures to write, and a PNG writer of their own, so
// that the reader is not tested with our writer's mistakes.
#pragma once

#include "media/image.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tidemark::image {

namespace fs = std::filesystem;

/// A fresh folder that goes with the test.
class PictureTest : public testing::Test {
protected:
    fs::path in_folder(const std::string& name) const { return folder_ / name; }
    fs::path folder() const { return folder_.path(); }
    size_t files() const {
        return size_t(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()));
    }
    fs::path put(const std::string& name, const std::string& bytes) const {
        fs::remove(in_folder(name)); // a file that is written over is flushed to the disk, which takes long
        std::ofstream(in_folder(name), std::ios::binary) << bytes;
        return in_folder(name);
    }

private:
    TemporaryFolder folder_;
};

/// Every sample different from its neighbours and from the same place in any other row or channel.
inline Image patterned_u8(Extent extent, int channels) {
    Image image(extent, channels, SampleType::u8);
    for (size_t i = 0; i < image.samples(); ++i)
        image.u8()[i] = uint8_t((i * 37 + (i * i) % 251 + i / image.row_bytes() * 11) & 0xff);
    return image;
}

/// The same as multiples of 1/64 between -2 and 2, which half holds exactly.
inline Image patterned_f32(Extent extent, int channels) {
    const Image bytes = patterned_u8(extent, channels);
    Image image(extent, channels, SampleType::f32);
    for (size_t i = 0; i < image.samples(); ++i)
        image.f32()[i] = (float(bytes.u8()[i]) - 128.0f) / 64.0f;
    return image;
}

inline Image opaque(Image image) {
    const auto channels = size_t(image.channels);
    for (size_t i = channels - 1; i < image.samples(); i += channels) {
        if (image.type == SampleType::u8)
            image.u8()[i] = 255;
        else
            image.f32()[i] = 1.0f;
    }
    return image;
}

inline std::string big_endian_32(uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

inline std::string png_chunk(const std::string& name, const std::string& data) {
    uint32_t crc = 0xffffffffu;
    for (const char c : name + data) {
        crc ^= uint8_t(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return big_endian_32(uint32_t(data.size())) + name + data + big_endian_32(~crc);
}

/// A zlib stream of one stored block.
inline std::string stored(const std::string& data) {
    uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + uint8_t(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto length = uint32_t(data.size());
    std::string stream = "\x78\x01\x01";
    for (const uint32_t word : {length, ~length}) {
        stream += char(word);
        stream += char(word >> 8);
    }
    return stream + data + big_endian_32(b << 16 | a);
}

inline std::string png_header(uint32_t width, uint32_t height, int depth, int colour) {
    return png_chunk("IHDR", big_endian_32(width) + big_endian_32(height) + char(depth) + char(colour) +
                                 std::string(3, '\0'));
}

inline const std::string k_png_signature = "\x89PNG\r\n\x1a\n";

/// `rows` hold the filter byte of every row; `middle` goes between header and data.
inline std::string hand_made_png(uint32_t width, uint32_t height, int depth, int colour,
                                 const std::string& rows, const std::string& middle = {}) {
    return k_png_signature + png_header(width, height, depth, colour) + middle +
           png_chunk("IDAT", stored(rows)) + png_chunk("IEND", {});
}

} // namespace tidemark::image
