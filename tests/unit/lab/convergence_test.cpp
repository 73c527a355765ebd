// Compares the estimated rest of a ladder with sums whose limit is known.
#include "lab/truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace tidemark::lab::convergence_test {

using Series = std::function<double(int n)>;

/// Returns the true rest divided by the estimated one, for `count` changes on a ladder that begins at `first`
/// and doubles each time.
double understated(const Series& value, double limit, int first, int count) {
    std::vector<double> changes;
    int n = first;
    for (int i = 0; i < count; ++i, n *= 2)
        changes.push_back(std::abs(value(2 * n) - value(n)));
    const Remainder left = remainder_of(changes, 1e-15);
    EXPECT_TRUE(left.error) << left.how;
    return left.error ? std::abs(limit - value(n)) / *left.error : 1e9;
}

double sum_of(int n, const std::function<double(double k)>& term) {
    double sum = 0;
    for (int k = n; k >= 1; --k)
        sum += term(k);
    return sum;
}

TEST(Remainder, EstimatesTheRemainderOfSums) {
    constexpr double k_zeta_1_1 = 10.5844484649508098; // zeta(1.1)
    const Series slow = [](int n) { return sum_of(n, [](double k) { return std::pow(k, -1.1); }); };
    const Series squares = [](int n) { return sum_of(n, [](double k) { return 1 / (k * k); }); };
    for (const int first : {4, 16, 64})
        for (const int changes : {2, 3, 5}) {
            SCOPED_TRACE(testing::Message() << first << ", " << changes << " changes");
            const double of_slow = understated(slow, k_zeta_1_1, first, changes);
            const double of_squares =
                understated(squares, std::numbers::pi * std::numbers::pi / 6, first, changes);
            EXPECT_LE(of_slow, 1);
            EXPECT_GE(of_slow, first == 4 ? 0.3 : 0.8);
            EXPECT_LE(of_squares, 1);
            EXPECT_GE(of_squares, 0.87);
        }
    // The last change alone would be 14 times too small.
    EXPECT_NEAR((k_zeta_1_1 - slow(256)) / (slow(256) - slow(128)), 13.97, 0.01);
}

TEST(Remainder, BoundsTheErrorOfFasterMethods) {
    const Series geometric = [](int n) { return 2 - std::pow(0.97, n); };
    const Series midpoint = [](int n) {
        return sum_of(n, [n](double k) { return std::exp((k - 0.5) / n) / n; });
    };
    const Series newton = [](int n) { // of the square root, from a bad start
        double x = 1e6;
        for (int i = 0; i < n; ++i)
            x = 0.5 * (x + 2 / x);
        return x;
    };
    EXPECT_LE(understated(geometric, 2, 32, 3), 1);
    EXPECT_LE(understated(geometric, 2, 16, 4), 1);
    EXPECT_NEAR(understated(midpoint, std::numbers::e - 1, 4, 3), 1, 0.02);
    EXPECT_LE(understated(newton, std::sqrt(2), 4, 3), 1);
}

TEST(Remainder, HoldsForRisingRatios) {
    const Series logarithm = [](int n) { return 1 - 1 / std::log(double(n)); };
    const Series square = [](int n) { return 1 - std::pow(std::log(double(n)), -2); };
    for (const int changes : {3, 4, 6}) {
        EXPECT_NEAR(understated(logarithm, 1, 8, changes), 1, 0.15) << changes;
        EXPECT_NEAR(understated(square, 1, 8, changes), 1, 0.15) << changes;
    }
}

TEST(Remainder, IsUnknownForDivergentSeries) {
    const Series harmonic = [](int n) { return sum_of(n, [](double k) { return 1 / k; }); };
    const Series slowest = [](int n) { return std::log(std::log(double(n))); };
    for (const auto& [series, first] : {std::pair{harmonic, 4}, {slowest, 4}}) {
        std::vector<double> changes;
        for (int n = first; n < 5000; n *= 2)
            changes.push_back(std::abs(series(2 * n) - series(n)));
        const Remainder left = remainder_of(changes, 1e-15);
        EXPECT_FALSE(left.error) << left.how;
        EXPECT_TRUE(left.how.starts_with("it does not converge")) << left.how;
    }
    EXPECT_FALSE(remainder_of({0.1, 0.1}, 0).error);
    EXPECT_FALSE(remainder_of({0.1, 0.2}, 0).error);
    EXPECT_FALSE(remainder_of({0.1}, 0).error);
    EXPECT_FALSE(remainder_of({}, 0).error);
    EXPECT_FALSE(remainder_of({0.1, std::nan("")}, 0).error);
    EXPECT_FALSE(remainder_of({std::nan(""), 0.1}, 0).error);
    EXPECT_FALSE(remainder_of({0.0, 0.1}, 0).error);
}

TEST(Remainder, IsRoundingWithoutChange) {
    const Remainder left = remainder_of({0.1, 1e-9}, 1e-8);
    EXPECT_TRUE(left.still);
    EXPECT_EQ(left.error, 1e-8);
}

} // namespace tidemark::lab::convergence_test
