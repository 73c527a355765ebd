#include "base/try.hpp"
#include "lab/device/device_checks.hpp"
#include "lab/device/sample_drawing.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tidemark::lab {
namespace {

constexpr int k_samples = 1 << 16;
constexpr double k_pi = 3.14159265358979323846;

/// A GLSL function over a range in which its precision is bounded by Vulkan 1.3 (Precision and Operation of
/// SPIR-V Instructions). GLSL itself requires less, or nothing.
struct BoundedFunction {
    std::string_view expression; ///< in x
    double low, high;
    double (*truth)(double);
    double absolute;       ///< allowed absolute error; 0: use ulps
    double ulps;           ///< allowed error in ulps
    double ulps_per_x = 0; ///< additional ulps per unit of |x|
};

constexpr BoundedFunction k_functions[] = {
    {"sin(x)", -k_pi, k_pi, [](double x) { return std::sin(x); }, 0x1p-11, 0},
    {"cos(x)", -k_pi, k_pi, [](double x) { return std::cos(x); }, 0x1p-11, 0},
    {"exp(x)", -20, 20, [](double x) { return std::exp(x); }, 0, 3, 2},
    {"exp2(x)", -20, 20, [](double x) { return std::exp2(x); }, 0, 3, 2},
    {"log(x)", 0.5, 2, [](double x) { return std::log(x); }, 0x1p-21, 0},
    {"log(x)", 2, 1e6, [](double x) { return std::log(x); }, 0, 3},
    {"log2(x)", 0.5, 2, [](double x) { return std::log2(x); }, 0x1p-21, 0},
    {"log2(x)", 2, 1e6, [](double x) { return std::log2(x); }, 0, 3},
    {"inversesqrt(x)", 1e-6, 1e6, [](double x) { return 1.0 / std::sqrt(x); }, 0, 2},
    {"atan(x)", -100, 100, [](double x) { return std::atan(x); }, 0, 4096},
};

/// The largest error as a share of the allowed one, and the x it occurs at.
struct LargestShare {
    double share = 0;
    double error = 0;
    double at = 0;
};

Result<LargestShare> look_at(const BoundedFunction& function) {
    LargestShare largest;
    const std::string statements = fmt::format("float x = spread(i, {:f}, {:f}); c.rg = vec2(x, {});",
                                               function.low, function.high, function.expression);
    for (const auto& [x, got, unused] : TRY(samples_of(statements, k_samples))) {
        const double truth = function.truth(double(x));
        const double ulps = ulps_between(truth, got);
        const double allowed = function.ulps + function.ulps_per_x * std::abs(double(x));
        const double error = function.absolute > 0 ? std::abs(double(got) - truth) : ulps;
        const double share = function.absolute > 0 ? error / function.absolute : error / allowed;
        if (!(share <= largest.share)) // also true for a NaN share
            largest = {share, error, double(x)};
    }
    return largest;
}

double largest_error_of_sine(const std::vector<Sample>& samples) {
    double largest = 0;
    for (const auto& [x, got, unused] : samples) {
        const double error = std::abs(double(got) - std::sin(double(x)));
        if (!(error <= largest))
            largest = error;
    }
    return largest;
}

} // namespace

Result<DeviceAnswer> ask_functions() {
    std::string outside, nearest;
    double most = 0;
    for (const BoundedFunction& function : k_functions) {
        const LargestShare found = TRY(look_at(function));
        const std::string words = fmt::format("{} is off by {:.2g}{} at x = {:.9g}", function.expression,
                                              found.error, function.absolute > 0 ? "" : " ulp", found.at);
        if (!(found.share <= 1))
            outside += (outside.empty() ? "" : ", ") + words;
        if (found.share > most) {
            most = found.share;
            nearest = fmt::format("{}, {:.0f} % of it", words, 100 * found.share);
        }
    }
    if (!outside.empty())
        return DeviceAnswer{Verdict::warn, "beyond the precision that Vulkan asks for: " + outside};
    return DeviceAnswer{Verdict::pass,
                        "within the precision that Vulkan asks for; nearest to its bound: " + nearest};
}

Result<DeviceAnswer> ask_large_sines() {
    std::string sentence;
    Verdict verdict = Verdict::pass;
    for (const double range : {1e2, 1e4, 1e6}) {
        const auto samples = TRY(samples_of(
            fmt::format("float x = spread(i, {0:f}, {1:f}); c.rg = vec2(x, sin(x));", -range, range),
            k_samples));
        const double error = largest_error_of_sine(samples);
        if (!(error <= 1e-5)) // hashes use the fifth digit and those after it
            verdict = Verdict::warn;
        sentence += fmt::format("{}{:.2g} up to |x| = {:g}", sentence.empty() ? "sin(x) is off by " : ", ",
                                error, range);
    }
    return DeviceAnswer{
        verdict,
        sentence + (verdict == Verdict::pass ? "" : "; hashes made of sines differ from other devices'")};
}

} // namespace tidemark::lab
