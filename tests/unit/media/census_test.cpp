#include "media/image.hpp"
#include "picture_support.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace tidemark::image::census_test {

Image with_bits(Extent extent, int channels, std::initializer_list<std::pair<size_t, uint32_t>> planted) {
    Image image(extent, channels, SampleType::f32);
    for (const auto& [sample, bits] : planted)
        std::memcpy(image.bytes.data() + 4 * sample, &bits, sizeof bits);
    return image;
}

TEST(Census, ordinary_numbers_are_not_counted) {
    // zeros, the smallest and largest normal numbers, and their negatives
    const FiniteCensus found = census(with_bits({3, 2}, 1,
                                                {{0, 0x00000000u},
                                                 {1, 0x80000000u},
                                                 {2, 0x00800000u},
                                                 {3, 0x80800000u},
                                                 {4, 0x7f7fffffu},
                                                 {5, 0xff7fffffu}}));
    EXPECT_EQ(found, (FiniteCensus{.samples = 6, .beyond_half = 2}));
    EXPECT_EQ(found.non_finite(), 0u);
}

TEST(Census, every_kind_is_counted_by_its_bits) {
    const FiniteCensus found = census(with_bits({4, 2}, 2,
                                                {{1, 0x00000001u},     // smallest subnormal
                                                 {2, 0x807fffffu},     // largest, negative
                                                 {5, 0x7f800000u},     // +inf
                                                 {6, 0x7f800001u},     // signalling NaN
                                                 {9, 0xffffffffu},     // NaN with its sign set
                                                 {10, 0x7fc00000u},    // quiet NaN
                                                 {15, 0xff800000u}})); // -inf
    EXPECT_EQ(found.samples, 16u);
    EXPECT_EQ(found.subnormal, 2u);
    EXPECT_EQ(found.nan, 3u);
    EXPECT_EQ(found.positive_infinity, 1u);
    EXPECT_EQ(found.negative_infinity, 1u);
    EXPECT_EQ(found.non_finite(), 5u);
    EXPECT_EQ(found.first_subnormal, (SamplePlace{0, 0, 1}));
    EXPECT_EQ(found.first_non_finite, (SamplePlace{2, 0, 1}));
}

TEST(Census, values_beyond_half_floats_are_counted_separately) {
    const FiniteCensus found = census(with_bits({4, 1}, 1,
                                                {{0, 0x477fe000u}, // 65504, the largest half
                                                 {1, 0x477fefffu}, // just below the middle: rounded down
                                                 {2, 0x477ff000u}, // 65520: rounded to infinity
                                                 {3, 0xc77ff000u}}));
    EXPECT_EQ(found, (FiniteCensus{.samples = 4, .beyond_half = 2}));
}

TEST(Census, the_place_counts_rows_from_the_bottom) {
    // sample 4 channels, 3 wide: row 1, column 2, channel 3
    const FiniteCensus found = census(with_bits({3, 2}, 4, {{4 * (3 + 2) + 3, 0x7fc00000u}}));
    EXPECT_EQ(found.first_non_finite, (SamplePlace{2, 1, 3}));
    EXPECT_EQ(found.first_subnormal, std::nullopt);
}

TEST(Census, bytes_are_always_finite) {
    const FiniteCensus found = census(patterned_u8({5, 4}, 3));
    EXPECT_EQ(found, (FiniteCensus{.samples = 60}));
}

TEST(TakeNonFinite, counts_pixels_of_floats_by_their_bits) {
    Image image({3, 2}, 4, SampleType::f32);
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    image.f32()[1] = nan;
    image.f32()[2] = infinity; // of the same pixel
    image.f32()[11] = -infinity;
    image.f32()[12] = std::numeric_limits<float>::max();
    image.f32()[13] = std::numeric_limits<float>::denorm_min();
    const Image before = image;
    EXPECT_EQ(take_non_finite(image), 2U);
    EXPECT_EQ(std::memcmp(image.bytes.data(), before.bytes.data(), image.bytes.size()), 0);
}

TEST(TakeNonFinite, takes_the_mark_from_bytes) {
    Image image({2, 2}, 4, SampleType::u8);
    const std::array<uint8_t, 16> marked{1, 2, 3, 255, 51, 51, 51, 51, 51, 0, 0, 0, 7, 8, 9, 51};
    std::ranges::copy(marked, image.u8().begin());
    EXPECT_EQ(take_non_finite(image), 2U);
    EXPECT_THAT(image.u8(), testing::ElementsAre(1, 2, 3, 255, 51, 51, 51, 255, 51, 0, 0, 0, 7, 8, 9, 255));
    EXPECT_EQ(take_non_finite(image), 0U);
}

} // namespace tidemark::image::census_test
