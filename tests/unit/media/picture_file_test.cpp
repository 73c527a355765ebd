// Pictures out and in again: every format, depth and number of channels; and files that others wrote.
#include "media/picture_file.hpp"
#include "picture_support.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace tidemark::image::picture_file_test {

using PictureFile = PictureTest;

PictureFormat of(SampleDepth depth) {
    return {depth, {}};
}

Image written_and_read(const fs::path& path, const Image& image, SampleDepth depth) {
    const Result<void> written = write_picture(path, image, of(depth));
    EXPECT_TRUE(written) << written.error().message;
    const Result<Image> read = read_picture(path);
    EXPECT_TRUE(read) << read.error().message;
    return read.value_or(Image());
}

/// v/255 as f32, which is how a deeper file comes back.
Image as_floats(const Image& bytes) {
    Image floats(bytes.extent, bytes.channels, SampleType::f32);
    for (size_t i = 0; i < bytes.samples(); ++i)
        floats.f32()[i] = float(bytes.u8()[i]) / 255.0f;
    return floats;
}

/// The half nearest to v in 0..1, ties to even, by arithmetic alone.
double nearest_half(double v) {
    if (v == 0.0)
        return 0.0;
    const double step = std::ldexp(1.0, std::max(std::ilogb(v), -14) - 10);
    return std::nearbyint(v / step) * step;
}

TEST_F(PictureFile, bytes_survive_every_lossless_byte_format) {
    for (const char* name : {"a.png", "a.tif", "a.tiff", "a.PNG"})
        for (const int channels : {1, 2, 3, 4}) {
            const Image image = patterned_u8({13, 7}, channels);
            EXPECT_EQ(written_and_read(in_folder(name), image, SampleDepth::u8), image)
                << name << ' ' << channels;
        }
}

TEST_F(PictureFile, bytes_in_wider_files_are_read_as_v_over_255) {
    for (const auto& [name, depth] : {std::pair{"a.png", SampleDepth::u16},
                                      {"a.tif", SampleDepth::u16},
                                      {"a.tif", SampleDepth::f32},
                                      {"a.exr", SampleDepth::f32}})
        for (const int channels : {1, 2, 3, 4}) {
            const Image image = patterned_u8({64, 16}, channels);
            EXPECT_EQ(written_and_read(in_folder(name), image, depth), as_floats(image))
                << name << ' ' << channels;
        }
}

TEST_F(PictureFile, bytes_become_the_nearest_half) {
    Image image({256, 1}, 1, SampleType::u8);
    for (size_t i = 0; i < 256; ++i)
        image.u8()[i] = uint8_t(i);
    const Image read = written_and_read(in_folder("a.exr"), image, SampleDepth::half);
    ASSERT_EQ(read.type, SampleType::f32);
    for (size_t i = 0; i < 256; ++i)
        EXPECT_EQ(double(read.f32()[i]), nearest_half(double(i) / 255.0)) << i;
}

TEST_F(PictureFile, floats_survive_every_float_format) {
    for (const auto& [name, depth] :
         {std::pair{"a.exr", SampleDepth::half}, {"a.exr", SampleDepth::f32}, {"a.tif", SampleDepth::f32}})
        for (const int channels : {1, 2, 3, 4}) {
            const Image image = patterned_f32({13, 7}, channels);
            EXPECT_EQ(written_and_read(in_folder(name), image, depth), image) << name << ' ' << channels;
        }
}

TEST_F(PictureFile, every_bit_of_a_float_survives) {
    Image image({12, 1}, 4, SampleType::f32);
    const uint32_t bits[] = {0x7fc00000u, 0xffc00000u, 0x7fffffffu, 0x7fc12345u, 0x7f800000u, 0xff800000u,
                             0x80000000u, 0x00000001u, 0x807fffffu, 0x7f7fffffu, 0x00800000u, 0x7f812345u};
    for (size_t i = 0; i < image.samples(); ++i)
        std::memcpy(image.bytes.data() + 4 * i, &bits[i % 12], 4);
    EXPECT_EQ(written_and_read(in_folder("a.exr"), image, SampleDepth::f32), image);
    EXPECT_EQ(written_and_read(in_folder("a.tif"), image, SampleDepth::f32), image);
}

TEST_F(PictureFile, a_half_keeps_non_finite_values_and_overflows_to_infinity) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    Image image({6, 1}, 1, SampleType::f32);
    std::ranges::copy(std::initializer_list<float>{NAN, inf, -inf, 65504.0f, 70000.0f, -0.0f},
                      image.f32().begin());
    const Image read = written_and_read(in_folder("a.exr"), image, SampleDepth::half);
    ASSERT_EQ(read.samples(), 6u);
    EXPECT_TRUE(std::isnan(read.f32()[0]));
    EXPECT_EQ(read.f32()[1], inf);
    EXPECT_EQ(read.f32()[2], -inf);
    EXPECT_EQ(read.f32()[3], 65504.0f);
    EXPECT_EQ(read.f32()[4], inf);
    EXPECT_TRUE(std::signbit(read.f32()[5]));
}

TEST_F(PictureFile, alpha_of_ones_is_left_out_and_any_other_kept) {
    for (const auto& [name, depth] : {std::pair{"a.png", SampleDepth::u8},
                                      {"a.png", SampleDepth::u16},
                                      {"a.tif", SampleDepth::u8},
                                      {"a.exr", SampleDepth::half}}) {
        Image image = opaque(patterned_u8({6, 5}, 4));
        EXPECT_EQ(written_and_read(in_folder(name), image, depth).channels, 3) << name;
        image.u8()[3] = 0; // over bright colours: a multiplication by alpha would show
        EXPECT_EQ(written_and_read(in_folder(name), image, depth).channels, 4) << name;
    }
    const Image clear = patterned_u8({6, 5}, 4);
    EXPECT_EQ(written_and_read(in_folder("a.jpg"), clear, SampleDepth::u8).channels, 3);
    EXPECT_EQ(written_and_read(in_folder("a.hdr"), clear, SampleDepth::f32).channels, 3);
}

TEST_F(PictureFile, the_last_row_of_an_image_is_the_first_of_the_file) {
    Image image({2, 2}, 3, SampleType::u8);
    std::ranges::copy(std::initializer_list<uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
                      image.u8().begin());
    // A PNG that lists the same rows from the top: unfiltered, red green blue
    const fs::path made =
        put("made.png", hand_made_png(2, 2, 8, 2, std::string("\0\7\x8\x9\xa\xb\xc\0\1\2\3\4\5\6", 14)));
    EXPECT_EQ(*read_picture(made), image);
    EXPECT_EQ(written_and_read(in_folder("a.png"), image, SampleDepth::u8), image);
    // An EXR's first scan line block holds y = 0; uncompressed samples would be the top row's. Through a
    // format that is read by another library than it was written by, top stays top:
    Image tall({1, 64}, 1, SampleType::u8);
    tall.u8()[63] = 255;
    for (const char* name : {"a.tif", "a.exr", "a.hdr", "a.jpg"}) {
        const Image read = written_and_read(in_folder(name), tall, natural_depth(name));
        const bool bytes = read.type == SampleType::u8;
        const auto last = size_t(63 * read.channels);
        EXPECT_GT(bytes ? float(read.u8()[last]) / 255.0f : read.f32()[last], 0.9f) << name;
        EXPECT_LT(bytes ? float(read.u8()[0]) / 255.0f : read.f32()[0], 0.1f) << name;
    }
}

TEST_F(PictureFile, a_jpeg_is_close_to_the_original) {
    for (const int channels : {1, 3}) {
        Image image({64, 48}, channels, SampleType::u8);
        for (size_t i = 0; i < image.samples(); ++i)
            image.u8()[i] = uint8_t(128.0 + 100.0 * std::sin(double(i / size_t(channels) % 64) * 0.05 +
                                                             double(i % size_t(channels))));
        const Image read = written_and_read(in_folder("a.jpg"), image, SampleDepth::u8);
        ASSERT_EQ(read.channels, channels);
        for (size_t i = 0; i < image.samples(); ++i)
            ASSERT_NEAR(read.u8()[i], image.u8()[i], 6) << i;
    }
}

TEST_F(PictureFile, radiance_keeps_eight_bits_of_the_largest_channel) {
    Image image({64, 9}, 3, SampleType::f32);
    for (size_t i = 0; i < image.samples(); ++i)
        image.f32()[i] = std::ldexp(1.0f + float(i % 61) / 61.0f, int(i / 3 % 40) - 20);
    const Image read = written_and_read(in_folder("a.hdr"), image, SampleDepth::f32);
    ASSERT_EQ(read.extent, image.extent);
    for (size_t pixel = 0; pixel < image.extent.pixels(); ++pixel) {
        const float* colour = &image.f32()[3 * pixel];
        const float largest = std::max({colour[0], colour[1], colour[2]});
        for (size_t channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(read.f32()[3 * pixel + channel], colour[channel], largest / 128.0f);
    }
}

TEST_F(PictureFile, radiance_clamps_values_out_of_range) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    Image image({3, 3}, 3, SampleType::f32);
    std::ranges::fill(image.f32(), 1.0f);
    image.f32()[0] = NAN;
    image.f32()[3] = -5.0f;
    image.f32()[6] = inf;
    const Image read = written_and_read(in_folder("a.hdr"), image, SampleDepth::f32);
    EXPECT_EQ(read.f32()[0], 0.0f);
    EXPECT_NEAR(read.f32()[1], 1.0f, 1.0f / 128.0f);
    EXPECT_EQ(read.f32()[3], 0.0f);
    EXPECT_GT(read.f32()[6], 1.6e38f);
    EXPECT_TRUE(std::isfinite(read.f32()[6]));
}

TEST_F(PictureFile, a_palette_becomes_its_colours) {
    const std::string palette = png_chunk("PLTE", std::string("\x10\x20\x30\xff\x80\x01", 6));
    // one bit a pixel, 1 0 1 -> 0xa0
    const fs::path path = put("p.png", hand_made_png(3, 1, 1, 3, std::string("\0\xa0", 2), palette));
    const Result<Image> read = read_picture(path);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->channels, 3);
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()),
              (std::vector<uint8_t>{255, 128, 1, 16, 32, 48, 255, 128, 1}));
}

TEST_F(PictureFile, a_transparent_palette_entry_keeps_its_colour) {
    const std::string middle = png_chunk("PLTE", std::string("\x10\x20\x30\xff\x80\x01", 6)) +
                               png_chunk("tRNS", std::string("\0\x40", 2));
    const Result<Image> read =
        read_picture(put("p.png", hand_made_png(2, 1, 8, 3, std::string("\0\0\1", 3), middle)));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->channels, 4);
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()),
              (std::vector<uint8_t>{16, 32, 48, 0, 255, 128, 1, 64}));
}

TEST_F(PictureFile, grey_of_few_bits_is_spread_over_the_byte) {
    // two bits a pixel, 0 1 2 3 -> 0x1b
    const Result<Image> read =
        read_picture(put("g.png", hand_made_png(4, 1, 2, 0, std::string("\0\x1b", 2))));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->channels, 1);
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()),
              (std::vector<uint8_t>{0, 85, 170, 255}));
}

TEST_F(PictureFile, sixteen_bits_are_v_over_65535) {
    const Result<Image> read =
        read_picture(put("w.png", hand_made_png(3, 1, 16, 0, std::string("\0\x12\x34\xff\xff\0\1", 7))));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->type, SampleType::f32);
    EXPECT_EQ(std::vector<float>(read->f32().begin(), read->f32().end()),
              (std::vector<float>{float(0x1234 / 65535.0), 1.0f, float(1 / 65535.0)}));
}

TEST_F(PictureFile, gamma_and_broken_profiles_are_ignored_silently) {
    const std::string rows("\0\x10\x80\xf0\x40", 5);
    const Image plain = *read_picture(put("plain.png", hand_made_png(1, 1, 8, 6, rows)));
    const std::string chatty = png_chunk("gAMA", big_endian_32(100000)) +
                               png_chunk("cHRM", std::string(32, '\1')) +
                               png_chunk("iCCP", std::string("x\0\0", 3) + stored("not a profile")) +
                               png_chunk("sRGB", std::string(1, '\0'));
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const Result<Image> read = read_picture(put("gamma.png", hand_made_png(1, 1, 8, 6, rows, chatty)));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, plain);
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()),
              (std::vector<uint8_t>{0x10, 0x80, 0xf0, 0x40}));
}

TEST_F(PictureFile, the_exif_orientation_is_ignored) {
    Image image({48, 16}, 3, SampleType::u8);
    for (size_t i = 0; i < image.samples(); ++i)
        image.u8()[i] = uint8_t(i / image.row_bytes() * 12);
    const Image plain = written_and_read(in_folder("a.jpg"), image, SampleDepth::u8);
    // Exif with one entry: Orientation (0x0112), SHORT, 6 = "turn right"
    const std::string exif("Exif\0\0MM\0*\0\0\0\x8\0\1\x1\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0", 32);
    std::string turned = bytes_of(in_folder("a.jpg"));
    turned.insert(2, std::string("\xff\xe1\0", 3) + char(exif.size() + 2) + exif);
    const Result<Image> read = read_picture(put("turned.jpg", turned));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, plain);
}

TEST_F(PictureFile, other_formats_are_detected_by_content) {
    const fs::path pgm = put("grey.picture", std::string("P5 2 2 255\n\1\2\3\4", 15));
    Result<Image> read = read_picture(pgm);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->channels, 1);
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()), (std::vector<uint8_t>{3, 4, 1, 2}));
    // An uncompressed TGA of 2x1, 24 bits, rows from the bottom, blue first
    std::string tga(18, '\0');
    tga[2] = 2, tga[12] = 2, tga[14] = 1, tga[16] = 24;
    read = read_picture(put("b.TGA", tga + std::string("\1\2\3\4\5\6")));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(std::vector<uint8_t>(read->u8().begin(), read->u8().end()),
              (std::vector<uint8_t>{3, 2, 1, 6, 5, 4}));
    // A PNG by another name
    ASSERT_TRUE(write_picture(in_folder("c.png"), patterned_u8({3, 3}, 3)));
    fs::rename(in_folder("c.png"), in_folder("c.jpg"));
    read = read_picture(in_folder("c.jpg"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, patterned_u8({3, 3}, 3));
}

TEST_F(PictureFile, a_picture_may_have_one_pixel) {
    for (const char* name : {"a.png", "a.tif", "a.exr", "a.jpg", "a.hdr"}) {
        const Image read = written_and_read(in_folder(name), patterned_u8({1, 1}, 3), natural_depth(name));
        EXPECT_EQ(read.extent, (Extent{1, 1})) << name;
    }
}

} // namespace tidemark::image::picture_file_test
