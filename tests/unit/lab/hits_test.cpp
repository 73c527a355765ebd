#include "lab/hits.hpp"
#include "shader/survey.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace tidemark::lab::hits_test {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

Hits hits(std::vector<double> distances, std::vector<uint8_t> flags = {}) {
    Hits made;
    made.distance = std::move(distances);
    made.evaluations.assign(made.size(), 10.0f);
    flags.resize(made.size());
    made.flags = std::move(flags);
    return made;
}

TEST(Hits, are_read_from_the_picture_of_main_hit) {
    image::Image image({3, 1}, 4, image::SampleType::f32);
    const float samples[] = {2.5f, 17, 1e-5f, 3, -1, 4, 0.5f, 0, std::nanf(""), 9, 0, 300};
    std::ranges::copy(samples, image.f32().begin());
    const Hits read = hits_of(image);
    EXPECT_EQ(read.distance[0], 2.5);
    EXPECT_EQ(read.distance[1], -1);
    EXPECT_TRUE(std::isnan(read.distance[2]));
    EXPECT_THAT(read.evaluations, testing::ElementsAre(17, 4, 9));
    EXPECT_THAT(read.flags, testing::ElementsAre(3, 0, 0));
}

TEST(Hits, views_are_joined_in_their_order) {
    const Hits all = joined({hits({1, -1}, {0, 2}), hits({}), hits({3}, {1})});
    EXPECT_THAT(all.distance, testing::ElementsAre(1, -1, 3));
    EXPECT_THAT(all.evaluations, testing::ElementsAre(10, 10, 10));
    EXPECT_THAT(all.flags, testing::ElementsAre(0, 2, 1));
    EXPECT_EQ(joined(std::vector<Hits>{}).size(), 0u);
}

TEST(Hits, a_negative_distance_other_than_a_miss_is_nan) {
    image::Image image({1, 1}, 4, image::SampleType::f32);
    image.f32()[0] = -0.5f;
    EXPECT_TRUE(std::isnan(hits_of(image).distance[0]));
}

TEST(Hits, invalid_evaluation_counts_are_left_out_of_the_mean) {
    image::Image image({4, 1}, 4, image::SampleType::f32);
    const float samples[] = {2, 6, 0, 0, 2, std::nanf(""), 0, 0, 2, -1, 0, 0, 2, 2, 0, 0};
    std::ranges::copy(samples, image.f32().begin());
    const HitErrors errors = hit_errors(hits({2, 2, 2, 2}), hits_of(image), std::vector<double>(4, 0.01));
    EXPECT_EQ(errors.no_answer, 50);
    EXPECT_EQ(errors.evaluations, 2); // (6 + 0 + 0 + 2) / 4
}

TEST(HitErrors, count_each_kind_of_error) {
    //                      right false miss false hit  +0.05  +0.5   both miss  NaN
    const Hits truth = hits({1.0, 2.0, -1.0, 4.0, 5.0, -1.0, 7.0});
    const Hits found = hits({1.0, -1.0, 3.0, 4.05, 5.5, -1.0, k_nan}, {0, 1, 0, 2, 0, 0, 0});
    const HitErrors errors = hit_errors(truth, found, std::vector<double>(7, 0.02));
    const double one = 100.0 / 7.0;
    EXPECT_EQ(errors.pixels, 7u);
    EXPECT_EQ(errors.both, 3u);
    EXPECT_NEAR(errors.rms, std::sqrt((0.0025 + 0.25) / 3), 1e-12);
    EXPECT_NEAR(errors.rms_right, std::sqrt(0.0025 / 2), 1e-12); // without the one that is off by 0.5
    EXPECT_NEAR(errors.median, 0.05, 1e-12);
    EXPECT_EQ(errors.largest, 0.5);
    EXPECT_DOUBLE_EQ(errors.false_miss, one);
    EXPECT_DOUBLE_EQ(errors.false_hit, one);
    EXPECT_DOUBLE_EQ(errors.wrong_hundredth, 5 * one); // miss, hit, 0.05, 0.5, NaN
    EXPECT_DOUBLE_EQ(errors.wrong_tenth, 4 * one);
    EXPECT_DOUBLE_EQ(errors.wrong_footprint, 4 * one); // a pixel is 0.08 wide at 4 and 0.1 at 5
    EXPECT_DOUBLE_EQ(errors.exhausted, one);
    EXPECT_DOUBLE_EQ(errors.negative, one);
    EXPECT_DOUBLE_EQ(errors.no_answer, one);
    EXPECT_EQ(errors.evaluations, 10);
}

TEST(HitErrors, quantiles_of_an_even_count_are_interpolated) {
    const HitErrors errors = hit_errors(hits({1, 1}), hits({1, 2}), std::vector<double>(2, 0.01));
    EXPECT_DOUBLE_EQ(errors.median, 0.5);
    EXPECT_DOUBLE_EQ(errors.p95, 0.95);
    EXPECT_DOUBLE_EQ(errors.p99, 0.99);
}

TEST(HitErrors, are_zero_for_equal_hits) {
    const Hits same = hits({1, -1, 3});
    const HitErrors errors = hit_errors(same, same, std::vector<double>(3, 0.01));
    EXPECT_EQ(errors.rms, 0);
    EXPECT_EQ(errors.wrong_hundredth, 0);
}

TEST(Causes, are_found_for_wrong_pixels) {
    const uint8_t exhausted = glsl::k_hit_exhausted, negative = glsl::k_hit_negative;
    const Hits truth = hits({5, 5, 5, 5, 5, 5, -1, -1, 5});
    const Hits found =
        hits({5.05, 9, 9, 9, 3, -1, 4, 4, k_nan}, {exhausted, exhausted, negative, 0, 0, 0, 0, exhausted, 0});
    EXPECT_THAT(causes(truth, found),
                testing::ElementsAre(Cause::right, Cause::exhaustion, Cause::sink, Cause::tunnel,
                                     Cause::early, Cause::tunnel, Cause::false_hit, Cause::exhaustion,
                                     Cause::no_answer));
    const auto counts = count(causes(truth, found));
    EXPECT_EQ(counts[size_t(Cause::right)], 1u);
    EXPECT_EQ(counts[size_t(Cause::exhaustion)], 2u);
}

TEST(Causes, have_distinct_colours) {
    std::vector<Cause> all;
    for (size_t i = 0; i < k_causes; ++i)
        all.push_back(Cause(i));
    const image::Image map = cause_map(all, {int(k_causes), 1});
    for (size_t i = 0; i < k_causes; ++i)
        for (size_t j = 0; j < i; ++j)
            EXPECT_NE(colour_of(Cause(i)), colour_of(Cause(j)));
    EXPECT_EQ(map.f32()[3], colour_of(Cause::exhaustion)[0]);
}

} // namespace tidemark::lab::hits_test
