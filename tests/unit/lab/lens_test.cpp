// Lenses: the forms of their names, statistics of known numbers, colours and the size of the legend.
#include "lab/lens.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tidemark::lab::lens_test {

using Mark = LensNumbers::Mark;
using Pick = glsl::SeenValue::Pick;

TEST(Lens, names_survive_parsing) {
    for (const char* text : {"cost", "steps", "steps:12", "error", "rounding", "proof", "clocks", "value:3",
                             "value:3:p.x", "value:3:hit.normal@min", "value:common.glsl:7:d@max",
                             "value:9:d@4", "branch:5", "branch:a.glsl:5:2"}) {
        const auto lens = parse_lens(text);
        ASSERT_TRUE(lens) << text;
        EXPECT_EQ(to_string(*lens), text);
    }
}

TEST(Lens, a_name_has_place_variable_and_selection) {
    const Lens lens = *parse_lens("value:common.glsl:7:p.y@3");
    EXPECT_EQ(lens.name, LensName::value);
    EXPECT_EQ(lens.place->file, "common.glsl");
    EXPECT_EQ(lens.place->line, 7);
    EXPECT_EQ(lens.variable, "p.y");
    EXPECT_EQ(lens.pick, Pick::number);
    EXPECT_EQ(lens.number, 3u);
}

TEST(Lens, malformed_names_are_refused) {
    for (const char* text :
         {"", "speed", "cost:3", "value", "value:p", "value:0", "value:3:a b", "value:3:p@0",
          "value:3:p@often", "steps@min", "branch", "branch:3:0", "branch:3:two", "proof:1"}) {
        const auto lens = parse_lens(text);
        ASSERT_FALSE(lens) << text;
        EXPECT_EQ(lens.error().code, ErrorCode::usage) << text;
    }
}

LensNumbers numbers_of(std::vector<float> values) {
    LensNumbers numbers;
    numbers.extent = {int(values.size()), 1};
    numbers.marks.assign(values.size(), Mark::number);
    numbers.values = std::move(values);
    return numbers;
}

TEST(Lens, statistics_leave_out_non_finite_numbers) {
    LensNumbers numbers = numbers_of({4, 1, 3, 2, std::nanf(""), std::numeric_limits<float>::infinity(), 9});
    numbers.marks[1] = Mark::marked;
    numbers.marks[6] = Mark::absent;
    const LensSummary summary = summary_of({}, numbers);
    EXPECT_EQ(summary.pixels, 7u);
    EXPECT_EQ(summary.numbers, 6u);
    EXPECT_EQ(summary.marked, 1u);
    EXPECT_EQ(summary.nan, 1u);
    EXPECT_EQ(summary.infinite, 1u);
    EXPECT_EQ(summary.least, 1);
    EXPECT_EQ(summary.median, 2.5);
    EXPECT_EQ(summary.most, 4);
}

TEST(Lens, a_frame_without_numbers_has_a_range_and_a_picture) {
    LensNumbers numbers = numbers_of({0, 0});
    numbers.marks.assign(2, Mark::absent);
    const LensSummary summary = summary_of({}, numbers);
    EXPECT_TRUE(std::isnan(summary.median));
    EXPECT_LT(range_of({}, summary).low, range_of({}, summary).high);
    EXPECT_EQ(draw_lens({}, numbers, legend_extent({}, {2, 1})).extent, legend_extent({}, {2, 1}));
}

TEST(Lens, the_legend_ends_at_round_numbers) {
    LensPlan plan;
    LensSummary summary;
    summary.least = 3;
    summary.most = 64;
    EXPECT_EQ(range_of(plan, summary).low, 0);
    EXPECT_EQ(range_of(plan, summary).high, 100);
    plan.lens.name = LensName::value;
    summary.least = -0.31;
    summary.most = 0.98;
    EXPECT_LE(range_of(plan, summary).low, -0.31);
    EXPECT_GE(range_of(plan, summary).high, 0.98);
    plan.logarithmic = true;
    summary.most = 37;
    EXPECT_NEAR(range_of(plan, summary).high, 100, 1e-9);
}

TEST(Lens, numbers_of_the_legend_are_short_and_plain) {
    EXPECT_EQ(legend_number(0.0000304), "3.04e-05");
    EXPECT_EQ(legend_number(0.123456), "0.1235");
    EXPECT_EQ(legend_number(9800), "9800");
    EXPECT_EQ(legend_number(10600.5), "10600");
    EXPECT_EQ(legend_number(-50000), "-50000");
    EXPECT_EQ(legend_number(195691), "195691");
    EXPECT_EQ(legend_number(12345678), "1.235e+07");
    EXPECT_EQ(legend_number(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Lens, a_share_is_rounded_to_all_or_nothing_only_if_it_is) {
    EXPECT_EQ(share_words(1), "100 %");
    EXPECT_EQ(share_words(0), "0 %");
    EXPECT_EQ(share_words(0.999783), "99.98 %");
    EXPECT_EQ(share_words(0.99996), "99.996 %");
    EXPECT_EQ(share_words(1 - 2e-7), "99.99998 %");
    EXPECT_EQ(share_words(0.995), "99.5 %");
    EXPECT_EQ(share_words(0.000217), "0.0217 %");
    EXPECT_EQ(share_words(0.125), "12.5 %");
}

LensNumbers ones(Extent extent) {
    LensNumbers numbers{.extent = extent};
    numbers.values.assign(extent.pixels(), 1);
    numbers.marks.assign(extent.pixels(), Mark::number);
    return numbers;
}

/// Returns the bytes of the picture's uppermost rows.
std::vector<uint8_t> top_rows(const image::Image& picture, int rows) {
    const auto samples = picture.u8();
    return {samples.end() - ptrdiff_t(4 * rows * picture.extent.width), samples.end()};
}

/// Returns how many rows at the bottom have one colour.
int empty_rows(const image::Image& picture) {
    const auto samples = picture.u8();
    const size_t row = 4 * size_t(picture.extent.width);
    for (size_t i = 0; i < samples.size(); ++i)
        if (samples[i] != samples[i % 4])
            return int(i / row);
    return picture.extent.height;
}

TEST(Lens, a_narrow_legend_has_more_rows) {
    LensPlan plan;
    plan.title = std::string(70, 'm');
    const LensNumbers numbers = ones({320, 180});
    const image::Image whole = draw_lens(plan, numbers);
    plan.title = std::string(53, 'm');
    EXPECT_NE(draw_lens(plan, numbers).bytes, whole.bytes) << "the rest of the title is in the second row";
    const int below = legend_extent(plan, {320, 180}).height - 180;
    EXPECT_GT(below, legend_extent(plan, {640, 360}).height - 360);
}

TEST(Lens, a_legend_of_one_picture_has_no_empty_row) {
    for (const int width : {128, 256, 400, 640, 1920})
        for (const int length : {10, 60, 150}) {
            LensPlan plan;
            plan.title = std::string(size_t(length), 'm');
            plan.marked = "run out of iterations";
            const int scale = std::max(1, width / 640), row_height = 11 * scale, margin = 4 * scale;
            const image::Image picture = draw_lens(plan, ones({width, 72}));
            EXPECT_GE(empty_rows(picture), margin) << width << " " << length;
            EXPECT_LT(empty_rows(picture), margin + row_height) << width << " " << length;
        }
}

TEST(Lens, the_legends_of_a_sequence_have_one_size) {
    LensPlan plan;
    plan.title = "a title";
    plan.marked = "run out of iterations";
    plan.absent = "no march";
    LensNumbers numbers = ones({256, 144});
    const Extent extent = legend_extent(plan, numbers.extent);
    const image::Image alone = draw_lens(plan, numbers);
    EXPECT_LE(alone.extent.height, extent.height);
    const image::Image first = draw_lens(plan, numbers, extent);
    EXPECT_EQ(first.extent, extent);
    EXPECT_EQ(top_rows(first, alone.extent.height), top_rows(alone, alone.extent.height));
    numbers.values[0] = std::nanf("");
    numbers.values[1] = std::numeric_limits<float>::infinity();
    numbers.marks[2] = Mark::absent;
    const image::Image full = draw_lens(plan, numbers);
    EXPECT_GT(full.extent.height, alone.extent.height);
    EXPECT_EQ(top_rows(draw_lens(plan, numbers, extent), full.extent.height),
              top_rows(full, full.extent.height));
}

TEST(Lens, a_legend_that_is_too_small_ends_with_dots) {
    LensPlan plan;
    plan.title = std::string(2000, 'm');
    const LensNumbers numbers = ones({256, 144});
    const image::Image picture = draw_lens(plan, numbers);
    EXPECT_LE(picture.extent.height, largest_legend_extent({256, 144}).height);
    plan.title.back() = 'n';
    EXPECT_EQ(draw_lens(plan, numbers).bytes, picture.bytes) << "the end of the title is left out";
    plan.title = "short";
    EXPECT_EQ(draw_lens(plan, numbers, Extent{256, 180}).extent, (Extent{256, 180}));
}

TEST(Lens, brightness_rises_along_the_colours) {
    double before = -1;
    for (int i = 0; i <= 100; ++i) {
        const auto [red, green, blue] = lens_colour(i / 100.0);
        const double light = 0.2126 * image::light_of_srgb(red / 255.0) +
                             0.7152 * image::light_of_srgb(green / 255.0) +
                             0.0722 * image::light_of_srgb(blue / 255.0);
        EXPECT_GE(light, before - 1e-3) << i;
        before = light;
    }
    EXPECT_EQ(lens_colour(-1), lens_colour(0));
    EXPECT_EQ(lens_colour(2), lens_colour(1));
}

TEST(Lens, pixels_without_a_number_have_their_own_colours) {
    LensNumbers numbers = numbers_of({0, 1, std::nanf(""), 1, 1});
    numbers.marks[3] = Mark::marked;
    numbers.marks[4] = Mark::absent;
    const image::Image map = lens_map({}, numbers);
    const auto colour = [&](size_t pixel) {
        return std::array{map.u8()[4 * pixel], map.u8()[4 * pixel + 1], map.u8()[4 * pixel + 2]};
    };
    EXPECT_EQ(colour(0), lens_colour(0));
    EXPECT_EQ(colour(1), lens_colour(1));
    EXPECT_EQ(colour(2), (std::array<uint8_t, 3>{255, 0, 255}));
    EXPECT_EQ(colour(3), (std::array<uint8_t, 3>{255, 255, 255}));
    EXPECT_EQ(colour(4), (std::array<uint8_t, 3>{0, 0, 0}));
}

TEST(Lens, a_picture_with_a_legend_has_even_sides) {
    for (const Extent map : {Extent{1, 1}, Extent{321, 181}, Extent{1920, 1080}, Extent{3840, 2160}})
        for (const Extent whole : {legend_extent({}, map), largest_legend_extent(map)}) {
            EXPECT_GE(whole.width, std::max(240, map.width));
            EXPECT_GT(whole.height, map.height);
            EXPECT_EQ(whole.width % 2 + whole.height % 2, 0);
        }
}

TEST(HotLines, a_share_is_the_median_of_the_rounds_times_the_part_that_was_not_repeated) {
    const LineShare plain = measured_share({0.3, 0.2, 0.1, 0.4, 0.9}, 1);
    EXPECT_DOUBLE_EQ(plain.share, 0.3);
    EXPECT_TRUE(plain.interval.contains(0.3));
    EXPECT_GE(plain.interval.low, 0.1);
    EXPECT_LE(plain.interval.high, 0.9);
    const LineShare whole = measured_share({0.3, 0.2, 0.1, 0.4, 0.9}, 2);
    EXPECT_DOUBLE_EQ(whole.share, 0.6) << "half of the line was repeated";
    EXPECT_DOUBLE_EQ(whole.interval.low, plain.interval.low * 2);
    EXPECT_DOUBLE_EQ(measured_share({0.2, 0.2, 0.2, 0.2, 0.2}, 1).interval.high, 0.2);
}

} // namespace tidemark::lab::lens_test
