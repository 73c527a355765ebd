// Held against MPFR with 200 bits: what a function makes of a number in an interval lies in what it makes of
// the interval.
#include "proof/interval.hpp"
#include "support/mpfr_number.hpp"

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace tidemark::proof::interval_test {

constexpr int k_intervals = 10'000; ///< of each function, five numbers in each

using Exact = MpfrNumber;

bool is_number(Exact& number) {
    return mpfr_number_p(number.get()) != 0;
}
bool within(Exact& number, const Interval& interval) {
    return mpfr_cmp_d(number.get(), interval.low) >= 0 && mpfr_cmp_d(number.get(), interval.high) <= 0;
}

/// Numbers of all sizes, whole ones, and the special ones.
class Numbers {
public:
    double next() {
        static constexpr std::array k_special{
            0.0,    -0.0,   1.0,      -1.0, 0.5, 2.0, 3.141592653589793, 1.5707963267948966,
            1e-300, -1e300, 4.9e-324, 1e16};
        switch (random_() % 6) {
        case 0: return k_special[random_() % k_special.size()];
        case 1: return double(int(random_() % 41) - 20);
        case 2: return std::ldexp(part() - 0.5, int(random_() % 200) - 100);
        default: return 20 * (part() - 0.5);
        }
    }
    Interval interval() {
        const double a = next();
        const double b = random_() % 4 == 0 ? a : random_() % 2 == 0 ? next() : a + std::ldexp(part(), -20);
        return {std::min(a, b), std::max(a, b)};
    }
    double inside(const Interval& interval, int which) {
        if (which < 2)
            return which == 0 ? interval.low : interval.high;
        return std::clamp(interval.low + part() * (interval.high - interval.low), interval.low,
                          interval.high);
    }

private:
    double part() { return double(random_()) / double(random_.max()); }
    std::mt19937 random_{7};
};

using Operands = std::array<Interval, 3>;

struct Case {
    std::string name;
    std::function<Interval(const Operands&)> bounds;
    std::function<void(mpfr_ptr result, std::array<Exact, 3>& operands)> exact;
};

using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

Case unary(std::string name, Interval (*bounds)(const Interval&), Unary exact) {
    return {std::move(name), [bounds](const Operands& x) { return bounds(x[0]); },
            [exact](mpfr_ptr result, auto& x) { exact(result, x[0].get(), MPFR_RNDN); }};
}
Case library(std::string name, double (*function)(double), Unary exact, double first = -k_infinity,
             double last = k_infinity) {
    return {std::move(name), [=](const Operands& x) { return increasing(function, x[0], first, last); },
            [exact](mpfr_ptr result, auto& x) { exact(result, x[0].get(), MPFR_RNDN); }};
}
Case binary(std::string name, Interval (*bounds)(const Interval&, const Interval&), Binary exact) {
    return {std::move(name), [bounds](const Operands& x) { return bounds(x[0], x[1]); },
            [exact](mpfr_ptr result, auto& x) { exact(result, x[0].get(), x[1].get(), MPFR_RNDN); }};
}

/// y floor(x / y); 200 bits are not enough for x / y of any two doubles, so the quotient has more.
void multiple_below(mpfr_ptr result, std::array<Exact, 3>& x) {
    mpfr_div(result, x[0].get(), x[1].get(), MPFR_RNDD);
    mpfr_floor(result, result);
    mpfr_mul(result, result, x[1].get(), MPFR_RNDN);
}
void exact_whole_multiple(mpfr_ptr result, std::array<Exact, 3>& x) {
    mpfr_t multiple;
    mpfr_init2(multiple, 2200);
    multiple_below(multiple, x);
    mpfr_set(result, multiple, MPFR_RNDN);
    mpfr_clear(multiple);
}
void exact_modulo(mpfr_ptr result, std::array<Exact, 3>& x) {
    mpfr_t multiple;
    mpfr_init2(multiple, 2200);
    multiple_below(multiple, x);
    mpfr_sub(result, x[0].get(), multiple, MPFR_RNDN);
    mpfr_clear(multiple);
}

void exact_fract(mpfr_ptr result, std::array<Exact, 3>& x) {
    mpfr_floor(result, x[0].get());
    mpfr_sub(result, x[0].get(), result, MPFR_RNDN);
}

void exact_mix(mpfr_ptr result, std::array<Exact, 3>& x) {
    Exact other;
    mpfr_ui_sub(result, 1, x[2].get(), MPFR_RNDN);
    mpfr_mul(result, result, x[0].get(), MPFR_RNDN);
    mpfr_mul(other.get(), x[1].get(), x[2].get(), MPFR_RNDN);
    mpfr_add(result, result, other.get(), MPFR_RNDN);
}

void exact_hermite(mpfr_ptr result, std::array<Exact, 3>& x) {
    mpfr_mul_ui(result, x[0].get(), 2, MPFR_RNDN);
    mpfr_ui_sub(result, 3, result, MPFR_RNDN);
    mpfr_mul(result, result, x[0].get(), MPFR_RNDN);
    mpfr_mul(result, result, x[0].get(), MPFR_RNDN);
}

const std::vector<Case>& cases() {
    static const std::vector<Case> k_cases = {
        {"modulo", [](const Operands& x) { return modulo(x[0], x[1]); }, exact_modulo},
        {"whole_multiple", [](const Operands& x) { return whole_multiple(x[0], x[1]); },
         exact_whole_multiple},
        {"fract", [](const Operands& x) { return fract(x[0]); }, exact_fract},
        {"mix", [](const Operands& x) { return mix(x[0], x[1], x[2]); }, exact_mix},
        {"hermite", [](const Operands& x) { return hermite(x[0]); }, exact_hermite},
        binary(
            "add", [](const Interval& a, const Interval& b) { return a + b; }, mpfr_add),
        binary(
            "subtract", [](const Interval& a, const Interval& b) { return a - b; }, mpfr_sub),
        binary(
            "multiply", [](const Interval& a, const Interval& b) { return a * b; }, mpfr_mul),
        binary(
            "divide", [](const Interval& a, const Interval& b) { return a / b; }, mpfr_div),
        binary("minimum", minimum, mpfr_min),
        binary("maximum", maximum, mpfr_max),
        binary("atan2", atan2, mpfr_atan2),
        binary("pow", pow, mpfr_pow),
        unary("square", square, mpfr_sqr),
        unary("absolute", absolute,
              [](mpfr_ptr r, mpfr_srcptr a, mpfr_rnd_t m) { return mpfr_abs(r, a, m); }),
        unary("sqrt", sqrt, mpfr_sqrt),
        unary("inverse_sqrt", inverse_sqrt, mpfr_rec_sqrt),
        unary("sin", sin, mpfr_sin),
        unary("cos", cos, mpfr_cos),
        unary("tan", tan, mpfr_tan),
        unary("cosh", cosh, mpfr_cosh),
        library("asin", std::asin, mpfr_asin, -1, 1),
        library("atan", std::atan, mpfr_atan),
        library("sinh", std::sinh, mpfr_sinh),
        library("tanh", std::tanh, mpfr_tanh),
        library("asinh", std::asinh, mpfr_asinh),
        library("acosh", std::acosh, mpfr_acosh, 1),
        library("atanh", std::atanh, mpfr_atanh, -1, 1),
        library("exp", std::exp, mpfr_exp),
        library("exp2", std::exp2, mpfr_exp2),
        library("log", std::log, mpfr_log, 0),
        library("log2", std::log2, mpfr_log2, 0),
    };
    return k_cases;
}

/// A power of a negative number is not defined in GLSL, whatever MPFR makes of it.
bool is_defined(const Case& function, std::array<Exact, 3>& operands) {
    return function.name != "pow" || mpfr_sgn(operands[0].get()) >= 0;
}

TEST(Interval, contains_the_function_values_of_all_its_numbers) {
    Numbers numbers;
    for (const Case& function : cases())
        for (int i = 0; i < k_intervals; ++i) {
            const Operands operands{numbers.interval(), numbers.interval(), numbers.interval()};
            const Interval bounds = function.bounds(operands);
            EXPECT_LE(bounds.low, bounds.high) << function.name;
            for (int which = 0; which < 5; ++which) {
                std::array<Exact, 3> at{Exact(numbers.inside(operands[0], which)),
                                        Exact(numbers.inside(operands[1], which)),
                                        Exact(numbers.inside(operands[2], which))};
                Exact result;
                function.exact(result.get(), at);
                if (!is_number(result) || !is_defined(function, at)) // infinite: beyond all doubles, too
                    ASSERT_TRUE(bounds.partial || bounds.contains(result.rounded()))
                        << function.name << " of " << at[0].rounded() << ", " << at[1].rounded();
                else
                    ASSERT_TRUE(within(result, bounds))
                        << function.name << " of " << at[0].rounded() << ", " << at[1].rounded() << " is "
                        << result.rounded() << " of [" << operands[0].low << ", " << operands[0].high
                        << "], [" << operands[1].low << ", " << operands[1].high << "], not in ["
                        << bounds.low << ", " << bounds.high << "]";
            }
        }
}

TEST(Interval, is_narrow_for_narrow_operands) {
    const Interval a{0.7, 0.7000001};
    for (const Interval& b : {sin(a), cos(a), sqrt(a), fract(a), square(a), increasing(std::exp, a)})
        EXPECT_LT(b.width(), 1e-6);
    EXPECT_LT(modulo({7.25, 7.2500001}, {2, 2}).width(), 1e-6);
}

TEST(Interval, a_root_of_a_sum_of_squares_is_defined_at_zero) {
    const Interval zero{0, 0};
    EXPECT_FALSE(sqrt(square(zero) + square(zero)).partial);
    EXPECT_FALSE(sqrt(square({-1, 1}) + square({-1, 1})).partial);
}

/// If it were widened, 0 or 1 times a number would not be a number of the text, and its hash would differ.
TEST(Interval, an_exact_product_is_not_widened) {
    EXPECT_TRUE((Interval{0, 0} * Interval{-3, 5}).point());
    EXPECT_TRUE((Interval{1, 1} * Interval{0.1, 0.1}).point());
    EXPECT_EQ((Interval{0.5, 3} * Interval{-0.25, -0.25}).high, -0.125);
    EXPECT_LT((Interval{0.1, 0.1} * Interval{0.1, 0.1}).low, (Interval{0.1, 0.1} * Interval{0.1, 0.1}).high);
}

/// Else its power is not defined.
TEST(Interval, a_quotient_has_the_sign_of_its_operands) {
    EXPECT_EQ((Interval{0, 1} / Interval{2, 3}).low, 0);
    EXPECT_EQ((Interval{0, 1} / Interval{-3, -2}).high, 0);
    EXPECT_EQ((Interval{-1, 0} / Interval{2, 3}).high, 0);
    EXPECT_LT((Interval{-1, 0} / Interval{2, 3}).low, -0.5);
}

TEST(Interval, an_exact_sum_is_not_widened) {
    EXPECT_EQ((Interval{0.01, 0.01} - Interval{0.01, 0.01}).high, 0);
    EXPECT_EQ((Interval{0.5, 3} + Interval{0.25, 0.25}).low, 0.75);
    EXPECT_LT((Interval{0.1, 0.1} + Interval{0.2, 0.2}).low, (Interval{0.1, 0.1} + Interval{0.2, 0.2}).high);
}

/// A driver may give either of NaN and a number: the number is within.
TEST(Interval, the_smaller_of_a_number_and_nan_may_be_the_number) {
    const Interval root = sqrt({-1, 4}), five{5, 5};
    EXPECT_TRUE(root.partial);
    EXPECT_EQ(minimum(root, five).high, 5);
    EXPECT_EQ(minimum(root, five).low, 0);
    EXPECT_EQ(maximum(root, Interval{-3, -3}).low, -3);
}

TEST(Interval, a_quotient_next_to_its_pole_is_bounded_on_one_side) {
    const Interval beside = Interval{1, 2} / Interval{0, 4};
    EXPECT_NEAR(beside.low, 0.25, 1e-12);
    EXPECT_EQ(beside.high, k_infinity);
    EXPECT_TRUE(beside.partial);
    EXPECT_NEAR((Interval{1, 2} / Interval{-4, 0}).high, -0.25, 1e-12);
    EXPECT_EQ((Interval{0, 2} / Interval{0, 4}).low, 0);
    EXPECT_EQ((Interval{1, 2} / Interval{-1, 4}).low, -k_infinity);
}

/// One number, so that a hash of it is the text's own.
TEST(Interval, the_multiple_below_an_interval_within_one_step_is_a_point) {
    EXPECT_TRUE(whole_multiple({7.25, 7.5}, {2, 2}).point());
    EXPECT_EQ(whole_multiple({7.25, 7.5}, {2, 2}).low, 6);
    EXPECT_EQ(whole_multiple({-0.5, -0.25}, {1, 1}).low, -1);
    EXPECT_EQ(whole_multiple({5.5, 6, false, true}, {3, 3}).high, 3);
}

TEST(Interval, an_angle_stays_on_its_side_of_the_cut) {
    const Interval left{-2, -1};
    EXPECT_GT(atan2({0, 0.1, false, false, true}, left).low, 3);
    EXPECT_LT(atan2({-0.1, 0, false, true}, left).high, -3);
    EXPECT_LT(atan2({-0.1, 0.1}, left).low, -3);
}

/// An interval that ends below a step keeps to its side of it.
TEST(Interval, an_open_end_is_not_beyond_the_step) {
    EXPECT_EQ(fract({0.75, 1, false, true}).high, 1);
    EXPECT_GE(fract({0.75, 1, false, true}).low, 0.7499);
    EXPECT_EQ(fract({0.75, 1}).low, 0);
    EXPECT_GE(modulo({5.5, 6, false, true}, {3, 3}).low, 2.4999);
    EXPECT_EQ(modulo({5.5, 6}, {3, 3}).low, 0);
}

} // namespace tidemark::proof::interval_test
