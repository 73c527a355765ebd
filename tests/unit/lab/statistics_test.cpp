#include "base/measurement.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tidemark::lab::statistics_test {

TEST(Statistics, quantiles_are_linear_between_neighbours) {
    EXPECT_EQ(median({3, 1, 2}), 2);
    EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
    EXPECT_EQ(quantile({0, 10}, 0.25), 2.5);
    EXPECT_EQ(quantile({7}, 0.9), 7);
    EXPECT_TRUE(std::isnan(median({})));
}

/// 200 draws of 40 normal numbers: the true median lies in about 190 of the intervals (standard deviation 3).
TEST(Statistics, the_interval_holds_the_true_median_in_95_of_100_cases) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(10.0, 2.0);
    int held = 0;
    double width = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<double> values(40);
        std::ranges::generate(values, [&] { return noise(random); });
        const Interval interval = bootstrap_median(values);
        held += interval.contains(10.0);
        width += (interval.high - interval.low) / 200;
    }
    EXPECT_GE(held, 180);
    EXPECT_LE(held, 199);
    // A median of n normal numbers has a standard deviation of 1.2533 sigma / sqrt(n).
    EXPECT_NEAR(width, 2 * 1.96 * 1.2533 * 2.0 / std::sqrt(40.0), 0.3);
}

TEST(Statistics, the_bound_of_a_proportion_is_wilsons) {
    EXPECT_NEAR(most_of_share(0, 2576), 2.7055434 / (2576 + 2.7055434), 1e-9);
    EXPECT_NEAR(most_of_share(5, 100), 0.09916, 5e-6); // by hand
    EXPECT_NEAR(most_of_share(100, 100), 1, 1e-12);
    EXPECT_EQ(most_of_share(0, 0), 1);
}

TEST(Statistics, few_values_have_no_interval) {
    const Interval interval = bootstrap_median({1, 2, 3, 4});
    EXPECT_TRUE(std::isnan(interval.low));
    EXPECT_FALSE(interval.contains(2.5));
    EXPECT_FALSE(interval.overlaps(interval));
}

TEST(Statistics, a_slowing_machine_is_detected) {
    std::vector<double> steady, slowing;
    for (int i = 0; i < 30; ++i) {
        steady.push_back(10 + 0.1 * (i % 3));
        slowing.push_back(10 + 0.1 * (i % 3) + (i >= 20 ? 2 : 0));
    }
    EXPECT_FALSE(summary_of(steady).drifted);
    const TimeSummary summary = summary_of(slowing);
    EXPECT_TRUE(summary.drifted);
    EXPECT_NEAR(summary.drift, 1.2, 0.01);
    EXPECT_EQ(summary.smallest, 10);
    EXPECT_EQ(summary.runs, 30u);
}

TEST(Statistics, shuffles_are_complete_repeatable_and_different) {
    const auto order = shuffled(50, 3);
    EXPECT_EQ(order, shuffled(50, 3));
    EXPECT_NE(order, shuffled(50, 4));
    auto sorted = order;
    std::ranges::sort(sorted);
    for (size_t i = 0; i < 50; ++i)
        EXPECT_EQ(sorted[i], i);
    // The C++ standard fixes this engine's numbers: the same order on every machine.
    EXPECT_THAT(shuffled(6, 1), testing::UnorderedElementsAre(0, 1, 2, 3, 4, 5));
}

} // namespace tidemark::lab::statistics_test
