#include "base/try.hpp"
#include "lab/device/device_checks.hpp"
#include "lab/device/sample_drawing.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace tidemark::lab {
namespace {

constexpr int k_number_samples = 1 << 16;

/// Two floats of any sign over 40 binary orders of magnitude.
constexpr std::string_view k_two_floats =
    "float a = uintBitsToFloat((bits(2u * i) & 0x807FFFFFu) | ((107u + bits(7u * i) % 40u) << 23));"
    "float b = uintBitsToFloat((bits(3u * i) & 0x807FFFFFu) | ((107u + bits(5u * i) % 40u) << 23));";

/// Returns a, b and `result`, an expression of both.
Result<std::vector<Sample>> of_two_floats(std::string_view result) {
    return samples_of(fmt::format("{} c.rgb = vec3(a, b, {});", k_two_floats, result), k_number_samples);
}

/// Counts results that differ from those of IEEE 754.
Result<int> wrongly_rounded(std::string_view expression, float (*truth)(float, float)) {
    int wrong = 0;
    for (const auto& [a, b, got] : TRY(of_two_floats(expression)))
        wrong += got != truth(a, b);
    return wrong;
}

Result<double> largest_float_error(std::string_view expression, double (*truth)(double, double)) {
    double largest = 0;
    for (const auto& [a, b, got] : TRY(of_two_floats(expression)))
        largest = std::max(largest, ulps_between(truth(double(a), double(b)), got));
    return largest;
}

/// Returns the double that a sample encodes as three numbers of 22, 22 and 20 bits.
double double_in(const Sample& sample) {
    const auto part = [&](size_t i) { return uint64_t(sample[i]); };
    return std::bit_cast<double>(part(0) | part(1) << 22 | part(2) << 44);
}

/// Returns the largest error in ulps of the true value; `truth` takes x, the sample's number plus 2.
Result<double> largest_double_error(std::string_view expression, double (*truth)(double)) {
    const std::vector<Sample> samples =
        TRY(samples_of(fmt::format("double x = double(i) + 2.0lf; uvec2 u = unpackDouble2x32({});"
                                   "c.rgb = vec3(float(u.x & 0x3FFFFFu), float((u.x >> 22) | ((u.y & 0xFFFu) "
                                   "<< 10)), float(u.y >> 12));",
                                   expression),
                       k_number_samples));
    double largest = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
        const double wanted = truth(double(i) + 2.0), got = double_in(samples[i]);
        largest = std::max(largest, std::abs(got - wanted) / std::ldexp(1.0, std::ilogb(wanted) - 52));
    }
    return largest;
}

} // namespace

Result<DeviceAnswer> ask_special_values() {
    // iTime is 0, and compilers cannot assume it.
    const Sample told = TRY(samples_of("float none = iTime / iTime, far = 1.0 / iTime;"
                                       "c.rgb = vec3(isnan(none), none != none, isinf(far));",
                                       1))[0];
    const Sample kept = TRY(samples_of("c.rgb = vec3(iTime / iTime, 1.0 / iTime, -iTime);", 1))[0];
    const Sample small =
        TRY(samples_of("c.r = uintBitsToFloat(0x00400000u + uint(iTime)) * (1.0 + iTime);", 1))[0];
    const bool negative_zero = std::signbit(kept[2]);
    if (told[0] != 1 || told[2] != 1 || !std::isnan(kept[0]) || !std::isinf(kept[1]))
        return DeviceAnswer{Verdict::fail, "NaN or infinity is lost: what is not finite is not found here"};
    return DeviceAnswer{told[1] == 1 && negative_zero ? Verdict::pass : Verdict::warn,
                        fmt::format("NaN and infinity stay; NaN {} itself; -0 {}; denormals {}",
                                    told[1] == 1 ? "differs from" : "equals",
                                    negative_zero ? "stays" : "becomes 0",
                                    small[0] != 0 ? "stay" : "become 0")};
}

Result<DeviceAnswer> ask_arithmetic() {
    const int sums = TRY(wrongly_rounded("a + b", [](float a, float b) { return a + b; }));
    const int products = TRY(wrongly_rounded("a * b", [](float a, float b) { return a * b; }));
    if (sums + products > 0)
        return DeviceAnswer{Verdict::fail,
                            fmt::format("{} of {} sums and {} products are not rounded as IEEE 754 asks",
                                        sums, k_number_samples, products)};
    const double quotient = TRY(largest_float_error("a / b", [](double a, double b) { return a / b; }));
    const double root =
        TRY(largest_float_error("sqrt(abs(a))", [](double a, double) { return std::sqrt(std::abs(a)); }));
    constexpr double k_allowed_quotient = 2.5; // Vulkan 1.3, Precision and Operation of SPIR-V Instructions
    return DeviceAnswer{
        quotient <= k_allowed_quotient ? Verdict::pass : Verdict::warn,
        fmt::format(
            "sums and products are exactly rounded; a / b is off by {:.2f} ulp at most, sqrt by {:.2f}",
            quotient, root)};
}

Result<DeviceAnswer> ask_contraction() {
    int once = 0, twice = 0, neither = 0;
    const std::string_view text = "float a = spread(2u * i, 1.0, 2.0), b = spread(3u * i, 1.0, 2.0);"
                                  "c.rgb = vec3(a, b, a * b + float(i) / 65536.0);";
    const std::vector<Sample> samples = TRY(samples_of(text, k_number_samples));
    for (size_t i = 0; i < samples.size(); ++i) {
        const auto [a, b, got] = samples[i];
        const float addend = float(i) / 65536.0f, fused = std::fma(a, b, addend), plain = a * b + addend;
        if (fused != plain)
            ++(got == fused ? once : got == plain ? twice : neither);
    }
    if (neither > 0)
        return DeviceAnswer{Verdict::fail, "a * b + c is rounded neither once nor twice"};
    return DeviceAnswer{Verdict::pass,
                        fmt::format("a * b + c is rounded {}", once == 0    ? "twice"
                                                               : twice == 0 ? "once (fused)"
                                                                            : "now once, now twice")};
}

Result<DeviceAnswer> ask_doubles() {
    const double quotient = TRY(largest_double_error("1.0lf / x", [](double x) { return 1.0 / x; }));
    const double root = TRY(largest_double_error("sqrt(x)", [](double x) { return std::sqrt(x); }));
    // GLSL sets no limit for doubles. Four ulps are far below any error reported of a picture.
    constexpr double k_harmless = 4;
    return DeviceAnswer{
        quotient <= k_harmless && root <= k_harmless ? Verdict::pass : Verdict::fail,
        fmt::format("1 / x is off by {:.3g} ulp of a double at most, sqrt by {:.3g}", quotient, root)};
}

} // namespace tidemark::lab
