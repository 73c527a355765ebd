#include "base/error.hpp"
#include "lab/device_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

constexpr int k_row = 256;

// PCG's hash (O'Neill 2014) uses integers only, so it is the same everywhere.
constexpr std::string_view k_frame = R"(uint bits(uint n) {{
    n = n * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28u) + 4u)) ^ n) * 277803737u;
    return (n >> 22u) ^ n;
}}
float spread(uint n, float a, float b) {{
    return a + (b - a) * (float(bits(n) >> 8u) / 16777216.0);
}}
void mainImage(out vec4 c, in vec2 p) {{
    uint i = uint(p.y) * {}u + uint(p.x);
    {}
}}
)";

double ulp_at(double number) {
    constexpr int k_least = std::numeric_limits<float>::min_exponent - 1;
    const int exponent = number == 0.0 ? k_least : std::max(std::ilogb(number), k_least);
    return std::ldexp(1.0, exponent - (std::numeric_limits<float>::digits - 1));
}

} // namespace

Result<render::Renderer> renderer_of(std::string_view text, const render::RenderOptions& options) {
    scene::Scene scene;
    scene.file = "self-test.glsl";
    scene.passes.resize(1);
    scene.passes[0].text.append(text, "self-test.glsl", 1);
    return render::Renderer::create(std::move(scene), options);
}

Result<std::vector<Sample>> samples_of(std::string_view statements, int count) {
    const Extent extent{k_row, (count + k_row - 1) / k_row};
    const std::string text = fmt::format(k_frame, k_row, statements);
    auto renderer = TRY(renderer_of(text, {.extent = extent, .samples = image::SampleType::f32}));
    renderer.draw({});
    const image::Image picture = renderer.read_back();
    std::vector<Sample> samples(extent.pixels());
    for (size_t i = 0; i < samples.size(); ++i)
        std::ranges::copy(picture.f32().subspan(4 * i, 3), samples[i].begin());
    return samples;
}

double ulps_between(double truth, float got) {
    if (float(truth) == got || (std::isnan(truth) && std::isnan(got)))
        return std::isfinite(got) ? std::abs(double(got) - truth) / ulp_at(truth) : 0.0;
    if (!std::isfinite(got) || !std::isfinite(truth))
        return std::numeric_limits<double>::infinity();
    return std::abs(double(got) - truth) / ulp_at(truth);
}

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

/// Returns the larger of two errors; a NaN counts as the largest.
double larger_error(double one, double other) {
    return std::isnan(one) || one > other ? one : other;
}

Result<double> largest_float_error(std::string_view expression, double (*truth)(double, double)) {
    double largest = 0;
    for (const auto& [a, b, got] : TRY(of_two_floats(expression)))
        largest = larger_error(largest, ulps_between(truth(double(a), double(b)), got));
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
        largest = larger_error(largest, std::abs(got - wanted) / std::ldexp(1.0, std::ilogb(wanted) - 52));
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
        return DeviceAnswer{Verdict::fail, "NaN or infinity is lost: probes cannot find them on this device"};
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
                            fmt::format("{} of {} sums and {} products are not rounded as IEEE 754 requires",
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
    return DeviceAnswer{Verdict::pass, fmt::format("a * b + c is rounded {}",
                                                   once == 0    ? "twice"
                                                   : twice == 0 ? "once (fused)"
                                                                : "sometimes once, sometimes twice")};
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
        if (std::isnan(largest.share)) // no error is larger
            break;
        if (!(share <= largest.share)) // also true for a NaN share
            largest = {share, error, double(x)};
    }
    return largest;
}

double largest_error_of_sine(const std::vector<Sample>& samples) {
    double largest = 0;
    for (const auto& [x, got, unused] : samples) {
        largest = larger_error(largest, std::abs(double(got) - std::sin(double(x))));
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
        return DeviceAnswer{Verdict::warn, "less precise than Vulkan requires: " + outside};
    return DeviceAnswer{Verdict::pass,
                        "within the precision that Vulkan requires; nearest to its bound: " + nearest};
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
    return DeviceAnswer{verdict,
                        sentence + (verdict == Verdict::pass
                                        ? ""
                                        : "; hashes made of sines differ from those of other devices")};
}

} // namespace tidemark::lab
