// Checks the slopes that differences of the field give, as used for normals. For scenes with a mainHit whose
// field is the march_field of shaders/lib/march.glsl, and for marches known from the text.
#include "lab/check/field_bench.hpp"
#include "lab/check/field_on_rays.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"
#include "lab/defined_numbers.hpp"
#include "lab/statistics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace tidemark::lab {
namespace {

/// Outputs the hit's distance and the field's slope along the ray there, from the difference over the knob
/// tidemark_step to either side.
constexpr std::string_view k_slope_hit = R"(void mainHit(out vec4 hit, in vec2 fragCoord) {
    tidemark_own_hit(hit, fragCoord);
    float t = max(hit.x, 0.0);
    float rise = march_field(t + tidemark_step) - march_field(t - tidemark_step);
    hit = vec4(hit.x, rise / (2.0 * tidemark_step), 0.0, 0.0);
}
)";

/// Returns the slope of each pixel; NaN if its ray misses.
std::vector<double> slopes(FieldBench& bench, double step, const FrameState& state) {
    const image::Image image = bench.ask({scene::KnobValue{step}}, state);
    std::vector<double> slopes;
    for (size_t i = 0; i < image.extent.pixels(); ++i) {
        const auto hit = image.f32().subspan(4 * i, 4);
        slopes.push_back(hit[0] >= 0 ? double(hit[1]) : std::nan(""));
    }
    return slopes;
}

/// Returns the median angle between two sets of slopes in degrees, or nothing if no ray has a finite slope in
/// both.
std::optional<double> median_angle(const std::vector<double>& slopes, const std::vector<double>& truth) {
    std::vector<double> angles;
    for (size_t i = 0; i < slopes.size(); ++i)
        if (std::isfinite(slopes[i]) && std::isfinite(truth[i]))
            angles.push_back(std::abs(std::atan(slopes[i]) - std::atan(truth[i])) * 180 / std::numbers::pi);
    if (angles.empty())
        return std::nullopt;
    return median(std::move(angles));
}

/// Returns the step widths of the scene's own differences, found by their names.
std::vector<double> own_steps(const scene::Scene& scene) {
    std::vector<double> steps;
    for (const DefinedNumber& number :
         defined_numbers(scene, {"normal_eps", "slope_distance", "normal_step"}))
        steps.push_back(number.value);
    for (const scene::Knob& knob : scene.knobs)
        if (speaks_of(knob.name, {"normal_eps", "slope_distance", "normal_step"})) {
            steps.push_back(knob.value[0]);
            if (knob.range)
                steps.push_back(knob.range->low[0]);
        }
    return steps;
}

/// Angle above which errors of the slopes show as facets.
constexpr double k_visible_angle = 1; // degree

/// Returns each ray's slope from the difference over `step` to either side.
using SlopesOver = std::function<std::vector<double>(double step)>;

Answer without_a_hit() {
    return {Verdict::not_applicable, "no ray hits the surface"};
}

/// Checks the differences over the scene's own step widths; returns nothing if they are good or the scene
/// names none.
std::optional<Answer> fault_of_own(const ProbeBench& bench, const SlopesOver& in_float,
                                   const std::vector<double>& truth, double best_step) {
    for (const double step : own_steps(bench.scene())) {
        const auto angle = median_angle(in_float(step), truth);
        if (!angle)
            return Answer{
                fault(bench),
                fmt::format("every slope over the scene's own {:g} is NaN or infinite; best is {:g}", step,
                            best_step),
                typical_view()};
        if (*angle > k_visible_angle)
            return Answer{
                fault(bench),
                fmt::format("over the scene's own {:g} half of the slopes along the rays are off by {:.2g} "
                            "degrees and more; best is {:g}",
                            step, *angle, best_step),
                typical_view()};
    }
    return std::nullopt;
}

Answer judged(const ProbeBench& bench, const SlopesOver& in_float, const SlopesOver& exact) {
    const std::vector<double> truth = exact(1e-6);
    // Filtered pictures and noise in floats have steps, so a true slope to compare with does not exist.
    if (const auto own = median_angle(exact(1e-5), truth); own && *own > 0.1)
        return {Verdict::not_applicable,
                fmt::format("the field is not smooth: in double its slopes over 1e-5 and 1e-6 are {:.2g} "
                            "degrees apart",
                            *own)};
    double best_step = 0, best = 1e9;
    std::string range;
    for (const double step : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto angle = median_angle(in_float(step), truth);
        if (!angle)
            return without_a_hit();
        range += fmt::format("{}{:.2g} over {:g}", range.empty() ? "" : ", ", *angle, step);
        if (*angle < best) {
            best = *angle;
            best_step = step;
        }
    }
    if (auto answer = fault_of_own(bench, in_float, truth, best_step))
        return *std::move(answer);
    return {best > k_visible_angle ? Verdict::warn : Verdict::pass,
            fmt::format("differences of the field give slopes along the rays to {:.2g} degrees at best, over "
                        "{:g} (medians: {})",
                        best, best_step, range)};
}

Result<Answer> ask_march_field(ProbeBench& bench) {
    if (!has_march_field(bench.scene()))
        return Answer{Verdict::not_applicable, "the scene has no march_field to take differences of"};
    const FieldQuestion question{k_slope_hit, {{.name = "tidemark_step"}}};
    auto in_float = FieldBench::create(bench.scene(), question, glsl::Precision::single);
    if (!in_float)
        return Answer{Verdict::not_applicable,
                      "the field does not compile on its own: " + to_string(in_float.error())};
    auto in_double = FieldBench::create(bench.scene(), question, glsl::Precision::promoted);
    if (!in_double)
        return Answer{Verdict::not_applicable, "cannot be drawn in double: " + to_string(in_double.error())};
    return judged(
        bench, [&](double step) { return slopes(*in_float, step, typical_view()); },
        [&](double step) { return slopes(*in_double, step, typical_view()); });
}

/// Checks the slopes at the march's hits, with the field from the scene's text.
Result<Answer> ask_recorded(ProbeBench& bench) {
    auto field = FieldOnRays::create(bench, typical_view());
    if (!field)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + field.error().message};
    const auto over = [&](double step, auto distance) {
        std::vector<double> slopes;
        for (size_t ray = 0; ray < field->rays(); ++ray) {
            const auto hit = field->hit(ray);
            const auto before = hit ? distance(ray, *hit - step) : std::nullopt;
            const auto behind = hit ? distance(ray, *hit + step) : std::nullopt;
            slopes.push_back(before && behind ? (*behind - *before) / (2 * step) : std::nan(""));
        }
        return slopes;
    };
    return judged(
        bench,
        [&](double step) {
            return over(step, [&](size_t ray, double at) { return field->in_float(ray, at); });
        },
        [&](double step) {
            return over(step, [&](size_t ray, double at) { return field->exact(ray, at); });
        });
}

} // namespace

Result<Answer> ask_normals(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    return bench.has_main_hit() ? ask_march_field(bench) : ask_recorded(bench);
}

} // namespace tidemark::lab
