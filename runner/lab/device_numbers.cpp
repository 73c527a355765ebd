#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/folders.hpp"
#include "base/measurement.hpp"
#include "lab/device_check.hpp"
#include "lab/lens.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace tidemark::lab {
namespace {

constexpr int k_row = 256;

// PCG's hash (O'Neill 2014) uses integers only, so it is the same everywhere.
constexpr std::string_view k_scene_frame = R"(uint bits(uint n) {{
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
    const std::string text = fmt::format(k_scene_frame, k_row, statements);
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

// Weights of operations: the time of each, compared with that of a sum.

namespace {

/// `{}`: the body of the loop. Two vectors of floats keep more than one operation on its way.
constexpr std::string_view k_timed_frame = R"(void mainImage(out vec4 c, in vec2 p) {{
    vec2 uv = p / 256.0;
    vec4 a = 0.5 + 0.1 * uv.xyxy * vec4(0.11, 0.23, 0.31, 0.47), b = 0.6 + 0.1 * uv.yxyx * vec4(0.37, 0.19, 0.41, 0.29);
    int count = iFrame;
    {}
    for (int i = 0; i < count; ++i) {{
        {}
    }}
    c = a + b;
}}
)";

struct TimedOperation {
    glsl::Operation operation;
    std::string_view statements;
    double times; ///< how often they do the operation
    double sums;  ///< that they do beside it
    int repeats;  ///< of the statements in one iteration; the other text has twice as many
};
constexpr TimedOperation k_timed_operations[] = {
    {glsl::Operation::sum, "a = a * 0.99 + 0.01; b = b * 0.98 + 0.02;", 16, 0, 8},
    {glsl::Operation::extremum, "a = max(0.9 - a, b); b = min(0.8 - b, a);", 8, 8, 4},
    {glsl::Operation::quotient, "a = b / a; b = a / b;", 8, 0, 4},
    {glsl::Operation::rounding, "a = fract(a + 0.37); b = fract(b + 0.41);", 8, 16, 4},
    {glsl::Operation::root, "a = sqrt(a + 1.0); b = sqrt(b + 1.1);", 8, 8, 4},
    {glsl::Operation::inverse_root, "a = inversesqrt(a + 1.0); b = inversesqrt(b + 1.1);", 8, 8, 4},
    {glsl::Operation::sine, "a = sin(a + 0.5); b = sin(b + 0.6);", 8, 8, 2},
    {glsl::Operation::arc, "a = atan(a + 0.3); b = atan(b + 0.4);", 8, 8, 2},
    {glsl::Operation::exponential, "a = exp(-a); b = exp(-b);", 8, 8, 2},
    {glsl::Operation::logarithm, "a = log(a + 2.0); b = log(b + 2.1);", 8, 8, 2},
    {glsl::Operation::power, "a = pow(a, b + 0.1); b = pow(b, a + 0.2);", 8, 8, 2},
    {glsl::Operation::lookup,
     "a = texture(iChannel0, uv + 0.0001 * a.xy); b = texture(iChannel0, uv + 0.0001 * b.xy);", 2, 8, 1},
    {glsl::Operation::lookup_level,
     "a = textureLod(iChannel0, uv + 0.0001 * a.xy, 0.0); b = textureLod(iChannel0, uv + 0.0001 * b.xy, "
     "0.0);",
     2, 8, 1},
    {glsl::Operation::fetch,
     "a = texelFetch(iChannel0, ivec2(90.0 * (uv + a.xy)) & 255, 0);"
     "b = texelFetch(iChannel0, ivec2(90.0 * (uv + b.xy)) & 255, 0);",
     2, 16, 1},
};

constexpr int k_timed_rounds = 7;
/// Widest interval of a sum's time, as a share of it, with which weights are kept.
constexpr double k_steady_share = 0.5;
constexpr double k_timed_ms = 12; ///< of one drawing, about
constexpr Extent k_small_picture{256, 128}, k_large_picture{2048, 1024};

/// A text that is drawn with so many iterations that it takes about k_timed_ms.
class TimedText {
public:
    static Result<TimedText> create(std::string_view before, const std::string& body, Extent extent) {
        scene::Scene scene;
        scene.file = "self-test.glsl";
        scene.passes.resize(1);
        scene.passes[0].text.append(fmt::format(k_timed_frame, before, body), "self-test.glsl", 1);
        scene.passes[0].channels[0] = {scene::Noise{}, scene::k_texture_sampling};
        render::RenderOptions options{.extent = extent, .samples = image::SampleType::f32};
        options.extras.unchanged = true;
        return TimedText(TRY(render::Renderer::create(std::move(scene), options)));
    }

    /// Returns the time of a drawing with that many iterations, in milliseconds.
    Elapsed draw(int iterations) {
        const Stopwatch watch;
        renderer_.draw(render::inputs_of_frame(iterations, 60));
        glFinish();
        return watch.elapsed();
    }

    /// Finds the number of iterations to draw with.
    void choose_iterations(bool by_cpu) {
        for (iterations_ = 1; iterations_ < (1 << 14); iterations_ *= 2)
            if (const Elapsed time = draw(iterations_); (by_cpu ? time.cpu : time.wall) > k_timed_ms)
                return;
    }
    void draw_like(const TimedText& other) { iterations_ = other.iterations_; }

    /// Adds a round. `by_cpu`: counts the CPU's time.
    void add(bool by_cpu) {
        const Elapsed time = draw(iterations_), empty = draw(0);
        times_.push_back(((by_cpu ? time.cpu : time.wall) - (by_cpu ? empty.cpu : empty.wall)) / iterations_);
    }
    /// Milliseconds of an iteration, one for each round.
    const std::vector<double>& times() const { return times_; }

private:
    explicit TimedText(render::Renderer renderer) : renderer_(std::move(renderer)) {}

    render::Renderer renderer_;
    int iterations_ = 1;
    std::vector<double> times_;
};

std::string repeated(std::string_view text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += std::string(text) + "\n        ";
    return all;
}

/// Statements that take long, for a branch or a loop that few pixels run.
constexpr std::string_view k_long_statements = "a = sin(a + 0.5); b = sin(b + 0.6);";
constexpr int k_sparse = 16; ///< one pixel of a block with that side runs the loop

/// The texts of the measurement, in the order of their numbers.
struct TimedTexts {
    std::vector<TimedText> all;
    size_t sparse = 0, dense = 0;     ///< a loop that few pixels run; that all run
    size_t branch = 0, no_branch = 0; ///< with a branch that no pixel takes; with its statements alone

    static Result<TimedTexts> create(Extent extent, bool by_cpu) {
        TimedTexts texts;
        const auto add = [&](std::string_view before, const std::string& body) -> Result<size_t> {
            texts.all.push_back(TRY(TimedText::create(before, body, extent)));
            return texts.all.size() - 1;
        };
        for (const TimedOperation& timed : k_timed_operations)
            for (const int times : {timed.repeats, 2 * timed.repeats})
                TRY(add("", repeated(timed.statements, times)));
        const std::string body = repeated(k_long_statements, 2);
        texts.dense = TRY(add("", body));
        texts.sparse =
            TRY(add(fmt::format("if (any(greaterThan(fract(p / {0:.1f}), vec2(1.0 / {0:.1f})))) count = 0;",
                                double(k_sparse)),
                    body));
        texts.branch = TRY(add("", "if (a.x > 100.0) {" + body + "}\n a = 0.999 * a;"));
        texts.no_branch = TRY(add("", body + "\n a = 0.999 * a;"));
        for (size_t i = 0; i < texts.all.size(); ++i)
            texts.all[i].choose_iterations(by_cpu);
        texts.all[texts.sparse].draw_like(texts.all[texts.dense]);
        return texts;
    }
};

/// The median of `value(round)` over the rounds, and its interval.
template <class Value>
std::pair<double, Interval> over_rounds(Value value) {
    std::vector<double> values;
    for (size_t round = 0; round < size_t(k_timed_rounds); ++round)
        values.push_back(value(round));
    return {median(values), bootstrap_median(values)};
}

constexpr uint64_t k_most_cached_weights = 1 << 20;

std::optional<FileCache> weights_cache() {
    const auto folder = user_cache_folder();
    return folder ? std::optional<FileCache>(FileCache(*folder / "weights", k_most_cached_weights))
                  : std::nullopt;
}

std::string key_of_device(const gl::Capabilities& device) {
    const std::string name = "weights 1\n" + device.device() + "\n" + device.version;
    return sha256(std::as_bytes(std::span(name)));
}

bool keep_weights(const gl::Capabilities& device, const glsl::WorkWeights& weights) {
    const auto cache = weights_cache();
    if (!cache)
        return false;
    const std::string key = key_of_device(device);
    cache->keep(
        key, nlohmann::json{{"of", weights.of}, {"lanes", weights.lanes}, {"both_sides", weights.both_sides}}
                 .dump());
    return cache->find(key).has_value();
}

} // namespace

glsl::WorkWeights device_weights() {
    const auto cache = weights_cache();
    const gl::Capabilities device = gl::query_capabilities();
    const auto kept = cache ? cache->find(key_of_device(device)) : std::nullopt;
    const auto json = nlohmann::json::parse(kept.value_or(""), nullptr, false);
    if (!json.is_object() || json.value("of", nlohmann::json()).size() != glsl::k_operations)
        return {};
    glsl::WorkWeights weights{.device = device.renderer};
    weights.of = json["of"];
    weights.lanes = json.value("lanes", 1);
    weights.both_sides = json.value("both_sides", false);
    return weights;
}

Result<MeasuredWeights> measure_weights() {
    TimedText first = TRY(TimedText::create("", repeated(k_long_statements, 2), k_small_picture));
    first.draw(1);
    const Elapsed trial = first.draw(1 << 6);
    const bool by_cpu = trial.cpu > 0.5 * trial.wall;
    const Extent extent = by_cpu ? k_small_picture : k_large_picture;
    TimedTexts texts = TRY(TimedTexts::create(extent, by_cpu));
    for (int round = 0; round < k_timed_rounds; ++round)
        for (TimedText& text : texts.all)
            text.add(by_cpu);
    const auto time = [&](size_t text, size_t round) { return texts.all[text].times()[round]; };
    const auto sum_of_round = [&](size_t round) {
        return (time(1, round) - time(0, round)) /
               (k_timed_operations[0].times * k_timed_operations[0].repeats);
    };
    MeasuredWeights measured;
    measured.weights.device = gl::query_capabilities().renderer;
    const auto [sum, interval_of_sum] = over_rounds(sum_of_round);
    measured.sum_picoseconds = 1e9 * sum / double(extent.pixels());
    const auto set = [&](glsl::Operation operation, auto value) {
        const auto [weight, interval] = over_rounds(value);
        measured.weights.of[size_t(operation)] = std::max(0.0, weight);
        measured.each.push_back({operation, weight, interval});
    };
    for (size_t i = 1; i < std::size(k_timed_operations); ++i) {
        const TimedOperation& timed = k_timed_operations[i];
        set(timed.operation, [&, of_sum = sum](size_t round) {
            const double more = (time(2 * i + 1, round) - time(2 * i, round)) / timed.repeats;
            return (more / of_sum - timed.sums) / timed.times;
        });
    }
    set(glsl::Operation::iteration, [&, of_sum = sum](size_t round) {
        constexpr double k_sums_of_head = 2; // the condition and the step
        return time(0, round) / of_sum - k_timed_operations[0].times * k_timed_operations[0].repeats -
               k_sums_of_head;
    });
    measured.weights.of[size_t(glsl::Operation::sum)] = 1;
    measured.weights.of[size_t(glsl::Operation::call)] = 0; // drivers inline functions
    const double lanes =
        k_sparse * k_sparse *
        over_rounds([&](size_t round) { return time(texts.sparse, round) / time(texts.dense, round); }).first;
    measured.weights.lanes = 1 << std::clamp(int(std::lround(std::log2(std::max(lanes, 1.0)))), 0, 6);
    measured.weights.both_sides = over_rounds([&](size_t round) {
                                      return time(texts.branch, round) / time(texts.no_branch, round);
                                  }).first > 0.5;
    measured.steady = sum > 0 && interval_of_sum.high - interval_of_sum.low < k_steady_share * sum;
    measured.kept = measured.steady && keep_weights(gl::query_capabilities(), measured.weights);
    return measured;
}

Result<DeviceAnswer> ask_weights() {
    const MeasuredWeights measured = TRY(measure_weights());
    std::string sentence;
    for (const MeasuredWeight& each : measured.each)
        sentence +=
            fmt::format("{}{} {:.1f} ({:.1f} to {:.1f})", sentence.empty() ? "" : ", ",
                        to_string(each.operation), each.weight, each.interval.low, each.interval.high);
    const glsl::WorkWeights& weights = measured.weights;
    return DeviceAnswer{
        Verdict::pass,
        fmt::format("in sums of {:.0f} ps: {}; {} pixels run together{}{}", measured.sum_picoseconds,
                    sentence, weights.lanes, weights.both_sides ? ", through both sides of branches" : "",
                    measured.kept     ? "; kept for the lens cost"
                    : measured.steady ? "; not kept, because there is no cache"
                                      : "; not kept, because the machine is too busy: run it again")};
}

} // namespace tidemark::lab
