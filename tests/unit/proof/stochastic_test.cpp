#include "ir_support.hpp"
#include "proof/number_systems.hpp"

#include <cmath>
#include <limits>

namespace tidemark::proof::stochastic_test {

Samples of(float a, float b, float c) {
    return {Point<float>{a, 0}, Point<float>{b, 0}, Point<float>{c, 0}};
}

/// `color.x` of that shader in a number system, with a value for iTime.
template <class System>
typename System::Value result(const Function& function, System system, typename System::Value time) {
    Evaluator<System> evaluator(function, system);
    if (const Variable* variable = function.find("iTime"))
        evaluator.memory()[variable->first] = time;
    Decisions decisions(0);
    EXPECT_EQ(evaluator.run(decisions, [](uint32_t) { return true; }), Ended::left);
    return evaluator.memory()[function.find("color")->first];
}

Samples stochastic(const Function& function, uint64_t seed, float time = 0) {
    return result(function, StochasticSystem(seed), StochasticSystem::all({time, 0}));
}

double digits(const Samples& samples) {
    return significant_digits({&samples, 1});
}

double mean_digits(const Function& function, float time = 0) {
    constexpr int k_seeds = 100;
    double sum = 0;
    for (uint64_t seed = 1; seed <= k_seeds; ++seed)
        sum += digits(stochastic(function, seed, time));
    return sum / k_seeds;
}

TEST(Stochastic, digits_are_the_common_digits_of_samples) {
    EXPECT_EQ(digits(of(2, 2, 2)), k_most_digits);
    EXPECT_EQ(digits(of(-1, 0, 1)), 0);
    EXPECT_EQ(digits(of(-1, 5, 1)), 0);
    // 1, 1.001, 0.999: s is 0.001, so log10(sqrt 3 / 0.0043027).
    EXPECT_NEAR(digits(of(1, 1.001f, 0.999f)), 2.605, 0.001);
}

TEST(Stochastic, non_finite_samples_have_digits_only_if_equal) {
    constexpr float k_nan = std::numeric_limits<float>::quiet_NaN(),
                    k_infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(digits(of(k_nan, k_nan, k_nan)), 0);
    EXPECT_EQ(digits(of(k_infinity, k_infinity, 1)), 0);
    EXPECT_EQ(digits(of(k_infinity, k_infinity, k_infinity)), k_most_digits);
}

TEST(Stochastic, a_vector_is_measured_by_its_length) {
    const Samples vector[] = {of(1e-6f, -1e-6f, 2e-6f), of(1, 1, 1)};
    EXPECT_LT(digits(vector[0]), 0.5);
    EXPECT_GT(significant_digits(vector), 5);
}

TEST(Stochastic, exact_operations_stay_exact) {
    const Function function = compiled("", "color = vec4((iTime + 0.25) * 3.0 - floor(iTime) / 4.0);");
    EXPECT_EQ(digits(stochastic(function, 1, 2.5f)), k_most_digits);
}

TEST(Stochastic, a_result_is_one_of_the_two_nearest_floats) {
    const Function function = compiled("", "color = vec4(iTime / 3.0);");
    const float below = 1.0f / 3, above = std::nextafter(below, 0.0f); // 1/3 lies between them
    bool saw_below = false, saw_above = false;
    for (uint64_t seed = 1; seed <= 20; ++seed)
        for (const Point<float>& sample : stochastic(function, seed, 1)) {
            EXPECT_TRUE(sample.real == below || sample.real == above);
            saw_below = saw_below || sample.real == below;
            saw_above = saw_above || sample.real == above;
        }
    EXPECT_TRUE(saw_below && saw_above);
}

/// 1 + x is rounded to 2^-23 at most: of x so many digits are left.
TEST(Stochastic, a_cancellation_loses_the_expected_digits) {
    const Function function = compiled("", "color = vec4((1.0 + iTime) - 1.0);");
    for (const float x : {1.2345e-2f, 1.2345e-4f, 1.2345e-6f})
        EXPECT_NEAR(mean_digits(function, x), std::log10(x / 0x1p-23), 1) << x;
}

/// S. M. Rump, Algorithms for verified inclusions (1988): not even the sign is right.
TEST(Stochastic, rumps_polynomial_has_no_digit) {
    const Function function = compiled(
        "", "float a = 77617.0 + iTime, b = 33096.0, a2 = a * a, b2 = b * b, b4 = b2 * b2, b6 = b4 * b2;\n"
            "color = vec4(333.75 * b6 + a2 * (11.0 * a2 * b2 - b6 - 121.0 * b4 - 2.0) + 5.5 * b4 * b4 +\n"
            "a / (2.0 * b));");
    EXPECT_LT(mean_digits(function), 0.5);
}

/// J.-M. Muller, Arithmétique des ordinateurs (1989): tends to 6, and in any floating point to 100.
TEST(Stochastic, mullers_recurrence_loses_a_digit_per_iteration) {
    const auto at = [](int turns) {
        return mean_digits(
            compiled("", "float x = 5.5 + iTime, y = 61.0 / 11.0;\n"
                         "for (int i = 0; i < " +
                             std::to_string(turns) +
                             "; ++i) { float z = 111.0 - (1130.0 - 3000.0 / x) / y; x = y; y = z; }\n"
                             "color = vec4(y);"));
    };
    EXPECT_GT(at(0), 6);
    EXPECT_NEAR((at(1) - at(4)) / 3, std::log10(100.0 / 6), 0.3); // the ratio of the two limits
    EXPECT_LT(at(6), 0.5);
    EXPECT_GT(at(20), 6); // it is 100 now, and sure of it
}

TEST(Stochastic, a_seed_is_repeatable) {
    const Function function = compiled("", "color = vec4(sin(iTime) / 3.0);");
    const Samples first = stochastic(function, 5, 1), again = stochastic(function, 5, 1);
    for (size_t i = 0; i < k_samples; ++i)
        EXPECT_EQ(first[i].real, again[i].real);
}

TEST(Lockstep, each_component_equals_its_own_evaluation) {
    const Function function =
        compiled("", "float a = iTime;\nfor (int i = 0; i < 9; ++i) a = mod(sin(a * 7.3) * 3.0, 0.7);\n"
                     "color = vec4(a);");
    const Point<float> time{1.7f, 0};
    const Lockstep all = result(function, LockstepSystem(3), LockstepSystem::exactly(time));
    EXPECT_EQ(all.in_float.real, result(function, PointSystem<float>(), time).real);
    EXPECT_EQ(all.in_double.real, result(function, PointSystem<double>(), {double(time.real), 0}).real);
    const Samples samples = stochastic(function, 3, time.real);
    for (size_t i = 0; i < k_samples; ++i)
        EXPECT_EQ(all.samples[i].real, samples[i].real);
}

TEST(Lockstep, branches_follow_the_float_value) {
    // In float the sum stays 1.
    const Function function = compiled(
        "", "float a = 1.0;\nfor (int i = 0; i < 9; ++i) a += iTime;\ncolor = vec4(a > 1.0 ? 2.0 : a);");
    const Lockstep all = result(function, LockstepSystem(), LockstepSystem::exactly(Point<float>{4e-8f, 0}));
    EXPECT_EQ(all.in_float.real, 1);
    EXPECT_GT(all.in_double.real, 1);
    EXPECT_LT(all.in_double.real, 1.1);
}

TEST(Lockstep, a_condition_that_differs_in_double_is_detected) {
    Lockstep condition = LockstepSystem::constant(1, Scalar::boolean);
    EXPECT_FALSE(condition.double_differs() || condition.rounding_decides());
    condition.in_double.bits = 0;
    EXPECT_TRUE(condition.double_differs());
    condition.samples[2].bits = 0;
    EXPECT_TRUE(condition.rounding_decides());
}

} // namespace tidemark::proof::stochastic_test
