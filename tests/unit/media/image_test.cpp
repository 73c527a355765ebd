#include "media/image.hpp"
#include "picture_support.hpp"

#include <cstring>

namespace tidemark::image::image_test {

TEST(Image, flipped_reverses_the_rows_only) {
    Image image({2, 3}, 1, SampleType::u8);
    std::ranges::copy(std::initializer_list<uint8_t>{1, 2, 3, 4, 5, 6}, image.u8().begin());
    const Image turned = flipped(image);
    EXPECT_EQ(std::vector<uint8_t>(turned.u8().begin(), turned.u8().end()),
              (std::vector<uint8_t>{5, 6, 3, 4, 1, 2}));
    EXPECT_EQ(turned.extent, image.extent);
}

TEST(Image, flipping_twice_changes_nothing) {
    for (const int channels : {1, 2, 3, 4}) {
        const Image image = patterned_f32({5, 4}, channels);
        EXPECT_NE(flipped(image), image);
        EXPECT_EQ(flipped(flipped(image)), image);
    }
}

TEST(Image, an_empty_picture_flips_to_itself) {
    EXPECT_EQ(flipped(Image()), Image());
}

TEST(Image, cropped_keeps_the_pixels_of_the_part) {
    for (const int channels : {1, 2, 3, 4})
        for (const SampleType type : {SampleType::u8, SampleType::f32})
            for (const Rectangle& area :
                 {Rectangle{2, 1, {3, 4}}, Rectangle{0, 0, {1, 1}}, Rectangle{6, 4, {1, 1}},
                  Rectangle{0, 2, {7, 2}}, Rectangle{0, 0, {7, 5}}}) {
                const Image image =
                    type == SampleType::u8 ? patterned_u8({7, 5}, channels) : patterned_f32({7, 5}, channels);
                const Image part = cropped(image, area);
                EXPECT_EQ(part.extent, area.extent);
                EXPECT_EQ(part.channels, channels);
                EXPECT_EQ(part.type, type);
                ASSERT_EQ(part.bytes.size(), part.samples() * size_of(type));
                const size_t pixel = size_t(channels) * size_of(type);
                for (size_t y = 0; y < size_t(area.extent.height); ++y)
                    for (size_t x = 0; x < size_t(area.extent.width); ++x)
                        EXPECT_EQ(
                            std::memcmp(&part.bytes[(y * size_t(area.extent.width) + x) * pixel],
                                        &image.bytes[((size_t(area.y) + y) * 7 + size_t(area.x) + x) * pixel],
                                        pixel),
                            0);
            }
}

TEST(Image, alpha_is_opaque_if_it_is_1_everywhere) {
    for (const int channels : {2, 4}) {
        Image bytes = opaque(patterned_u8({3, 3}, channels));
        EXPECT_TRUE(has_opaque_alpha(bytes));
        bytes.u8().back() = 254;
        EXPECT_FALSE(has_opaque_alpha(bytes));
        Image floats = opaque(patterned_f32({3, 3}, channels));
        EXPECT_TRUE(has_opaque_alpha(floats));
        floats.f32()[size_t(channels) - 1] = 1.0000001f;
        EXPECT_FALSE(has_opaque_alpha(floats));
    }
}

TEST(Image, a_picture_without_alpha_has_no_opaque_alpha) {
    Image white({2, 2}, 3, SampleType::u8);
    std::ranges::fill(white.u8(), uint8_t{255});
    EXPECT_FALSE(has_opaque_alpha(white));
    EXPECT_EQ(without_alpha(white), white);
}

TEST(Image, without_alpha_keeps_the_colours_in_place) {
    Image image({2, 1}, 4, SampleType::u8);
    std::ranges::copy(std::initializer_list<uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}, image.u8().begin());
    const Image colours = without_alpha(image);
    EXPECT_EQ(colours.channels, 3);
    EXPECT_EQ(std::vector<uint8_t>(colours.u8().begin(), colours.u8().end()),
              (std::vector<uint8_t>{1, 2, 3, 5, 6, 7}));
}

TEST(Image, without_alpha_keeps_the_bits_of_a_nan) {
    Image image({1, 1}, 2, SampleType::f32);
    const uint32_t signalling = 0x7fa12345u;
    std::memcpy(image.bytes.data(), &signalling, sizeof signalling);
    uint32_t bits;
    std::memcpy(&bits, without_alpha(image).bytes.data(), sizeof bits);
    EXPECT_EQ(bits, signalling);
}

} // namespace tidemark::image::image_test
