#include "media/texture_files.hpp"
#include "unit/media/picture_support.hpp"

#include <gmock/gmock.h>

#include <cstring>
#include <random>

namespace tidemark::image::volume_file_test {

using testing::HasSubstr;

std::string little_endian(uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> (8 * i));
    return text;
}

struct Header {
    uint32_t width = 2, height = 3, depth = 4;
    uint32_t channels = 1, layout = 0, format = 0;

    std::string bytes() const {
        return std::string("BIN\0", 4) + little_endian(width, 4) + little_endian(height, 4) +
               little_endian(depth, 4) + little_endian(channels, 1) + little_endian(layout, 1) +
               little_endian(format, 2);
    }
};

std::string counting(size_t count) {
    std::string bytes(count, '\0');
    for (size_t i = 0; i < count; ++i)
        bytes[i] = char(i * 7 + 3);
    return bytes;
}

std::string message_of(const std::string& file) {
    const Result<VolumeData> volume = volume_of(file, "v.bin");
    return volume ? "no error" : volume.error().message;
}

TEST(VolumeFile, bytes_are_kept_in_the_order_of_the_file) {
    for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
        const std::string samples = counting(24 * channels);
        const Result<VolumeData> volume =
            volume_of(Header{.channels = channels, .layout = 1}.bytes() + samples, "v.bin");
        ASSERT_TRUE(volume) << volume.error().message;
        EXPECT_EQ(volume->width, 2);
        EXPECT_EQ(volume->height, 3);
        EXPECT_EQ(volume->depth, 4);
        EXPECT_EQ(volume->channels, int(channels));
        EXPECT_EQ(volume->type, SampleType::u8);
        ASSERT_EQ(volume->bytes.size(), samples.size());
        EXPECT_EQ(std::memcmp(volume->bytes.data(), samples.data(), samples.size()), 0);
    }
}

TEST(VolumeFile, floats_keep_their_bits) {
    const std::string samples = counting(24 * 4);
    const Result<VolumeData> volume = volume_of(Header{.format = 10}.bytes() + samples, "v.bin");
    ASSERT_TRUE(volume) << volume.error().message;
    EXPECT_EQ(volume->type, SampleType::f32);
    EXPECT_EQ(std::memcmp(volume->bytes.data(), samples.data(), samples.size()), 0);
}

TEST(VolumeFile, truncated_and_extended_files_are_refused) {
    const std::string file = Header{.channels = 4}.bytes() + counting(96);
    ASSERT_EQ(message_of(file), "no error");
    for (size_t length = 0; length < file.size(); ++length)
        EXPECT_THAT(message_of(file.substr(0, length)), testing::StartsWith("cannot read 'v.bin': "));
    EXPECT_EQ(message_of(file + "x"),
              "cannot read 'v.bin': 2x3x4 texels of 4 channels need 96 bytes of samples, but it has 97");
}

TEST(VolumeFile, errors_are_reported) {
    const std::string samples = counting(24);
    EXPECT_EQ(message_of("PNG"), "cannot read 'v.bin': it is not a ShaderToy volume: it does not start with "
                                 "\"BIN\" and a zero byte");
    EXPECT_EQ(message_of(std::string("BIN\0\1", 5)),
              "cannot read 'v.bin': the file is cut short: a volume's header has 20 bytes");
    EXPECT_EQ(message_of(Header{.depth = 0}.bytes()),
              "cannot read 'v.bin': its size is 2x3x0: it has no texels");
    EXPECT_EQ(message_of(Header{.width = 513}.bytes() + samples),
              "cannot read 'v.bin': its size is 513x3x4; the limit is 512 on a side");
    EXPECT_EQ(message_of(Header{.channels = 5}.bytes() + samples),
              "cannot read 'v.bin': it has 5 channels; 1 to 4 are allowed");
    EXPECT_EQ(message_of(Header{.format = 3}.bytes() + samples),
              "cannot read 'v.bin': its sample format is 3; known are 0 (bytes) and 10 (32-bit floats)");
    EXPECT_EQ(message_of(Header{512, 512, 512, 4, 0, 10}.bytes() + samples),
              "cannot read 'v.bin': it has 2147483648 bytes of samples; the limit is 1024 MiB");
}

TEST(VolumeFile, sizes_whose_product_overflows_are_refused) {
    for (const uint32_t size : {0x10000u, 0x80000000u, 0xffffffffu})
        EXPECT_THAT(message_of(Header{size, size, size}.bytes()), HasSubstr("the limit is 512"));
}

TEST(VolumeFile, arbitrary_headers_do_not_crash) {
    std::mt19937 random(1);
    const std::string file = Header{}.bytes() + counting(24);
    for (int i = 0; i < 20000; ++i) {
        std::string damaged = file.substr(0, random() % (file.size() + 1));
        for (uint32_t changes = random() % 4; changes > 0 && damaged.size() > 4; --changes)
            damaged[4 + random() % (damaged.size() - 4)] = char(random());
        if (const Result<VolumeData> volume = volume_of(damaged, "v.bin")) {
            EXPECT_EQ(volume->bytes.size(), volume->samples() * size_of(volume->type));
        }
    }
}

class VolumeFileOnDisk : public PictureTest {};

TEST_F(VolumeFileOnDisk, is_read_and_named) {
    const fs::path path = put("a.bin", Header{}.bytes() + counting(24));
    ASSERT_TRUE(read_volume(path));
    EXPECT_EQ(*read_volume(path), *volume_of(bytes_of(path), "a"));
    const auto missing = read_volume(in_folder("b.bin"));
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::load);
    EXPECT_EQ(missing.error().message, "cannot read '" + in_folder("b.bin").string() + "': no such file");
}

} // namespace tidemark::image::volume_file_test
