// Evaluates the distance field of a scene along its rays by replacing mainHit. Only for scenes with a mainHit
// whose field is the march_field of shaders/lib/march.glsl. A context must be current while a bench exists.

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/probe_bench.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "shader/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// A GLSL function that is evaluated in each ray's pixel.
struct FieldQuestion {
    /// A mainHit in GLSL, placed after `#undef mainHit`. It may call the scene's own as tidemark_own_hit.
    std::string_view hit;
    std::vector<scene::Knob> knobs; ///< its parameters, added to the scene's knobs
};

class FieldBench {
public:
    /// Requires a scene with a mainHit. Fails if the scene with that function does not compile or cannot be
    /// promoted to double.
    static Result<FieldBench> create(const scene::Scene& scene, const FieldQuestion& question,
                                     glsl::Precision precision);

    /// Draws and returns the results, RGBA floats. `values` are those of the question's knobs, in their
    /// order.
    image::Image ask(std::initializer_list<scene::KnobValue> values, const FrameState& state);

private:
    FieldBench(render::Renderer renderer, std::vector<scene::Knob> knobs, size_t first)
        : renderer_(std::move(renderer)), knobs_(std::move(knobs)), first_(first) {}
    render::Renderer renderer_;
    std::vector<scene::Knob> knobs_;
    size_t first_; ///< index of the question's first knob
};

bool has_march_field(const scene::Scene& scene) {
    return scene.image().text.text().find("march_field") != std::string::npos;
}

Result<FieldBench> FieldBench::create(const scene::Scene& scene, const FieldQuestion& question,
                                      glsl::Precision precision) {
    scene::Scene asked = *glsl::hit_scene(scene);
    text::MappedText& text = asked.passes[asked.image_index()].text;
    text::MappedText whole;
    whole.append_generated("#define mainHit tidemark_own_hit\n");
    whole.append(text);
    whole.append_generated("#undef mainHit\n");
    whole.append_generated(question.hit);
    text = std::move(whole);
    const size_t first = asked.knobs.size();
    std::ranges::copy(question.knobs, std::back_inserter(asked.knobs));
    std::vector<scene::Knob> knobs = asked.knobs;
    auto made =
        render::Renderer::create(std::move(asked), {k_ray_extent, image::SampleType::f32, {}, precision});
    if (!made)
        return fail(std::move(made.error()));
    return FieldBench(*std::move(made), std::move(knobs), first);
}

image::Image FieldBench::ask(std::initializer_list<scene::KnobValue> values, const FrameState& state) {
    size_t knob = first_;
    for (const scene::KnobValue& value : values)
        knobs_[knob++].value = value;
    renderer_.turn(knobs_);
    renderer_.draw(inputs_of(state));
    return renderer_.read_back();
}

// Compares the slope bound that a solver's steps rely on with the largest slope that a search finds. For
// scenes with a mainHit whose field is the march_field of shaders/lib/march.glsl, and for recorded marches.

namespace {

/// Samples sixteen places of the ray through a pixel of the window tidemark_pixels (low and high corner), up
/// to its hit and within tidemark_distances. Outputs the steepest: its pixel, its distance, and the slope
/// from the difference over tidemark_step to either side. By the mean value theorem that is a slope of the
/// field between both ends, so apart from rounding the result is never too large.
constexpr std::string_view k_steepest_hit = R"(void mainHit(out vec4 hit, in vec2 fragCoord) {
    vec2 pixel = mix(tidemark_pixels.xy, tidemark_pixels.zw, fragCoord / iResolution.xy);
    tidemark_own_hit(hit, pixel);
    float last = hit.x < 0.0 ? tidemark_distances.y : min(hit.x, tidemark_distances.y);
    float first = min(tidemark_distances.x, last);
    hit = vec4(pixel, 0.0, -1.0);
    float before = 0.0;
    for (int i = 0; i < 32; ++i) { // one call, so that a compiler need not hold two copies of the field
        float side = (i & 1) == 0 ? -tidemark_step : tidemark_step;
        float t = mix(first, last, (float(i / 2) + 0.5) / 16.0);
        float value = march_field(t + side);
        float slope = abs(value - before) / (2.0 * tidemark_step);
        if (side > 0.0 && slope > hit.w) {
            hit.zw = vec2(t, slope);
        }
        before = value;
    }
}
)";

struct Steep {
    double slope = -1;
    double distance = 0;
    glm::dvec2 pixel{0};
    FrameState view{};
};

bool steeper(const Steep& one, const Steep& other) {
    return one.slope > other.slope;
}

/// A window of the picture and of the distances along its rays.
struct Window {
    glm::dvec2 low{0}, high{k_ray_extent.width, k_ray_extent.height};
    double near = 0, far = 0;
};

/// Returns the window that extends to each side of a place by `part` of the whole.
Window around(const Steep& place, const Window& whole, double part) {
    const glm::dvec2 pixels = part * (whole.high - whole.low);
    const double distance = part * (whole.far - whole.near);
    return {glm::max(place.pixel - pixels, whole.low), glm::min(place.pixel + pixels, whole.high),
            std::max(place.distance - distance, whole.near), std::min(place.distance + distance, whole.far)};
}

class SlopeSearch {
public:
    static Result<SlopeSearch> create(const ProbeBench& bench, double furthest, glsl::Precision precision) {
        const FieldQuestion question{k_steepest_hit,
                                     {{.name = "tidemark_pixels", .type = scene::KnobType::vec4},
                                      {.name = "tidemark_distances", .type = scene::KnobType::vec2},
                                      {.name = "tidemark_step"}}};
        auto field = TRY(FieldBench::create(bench.scene(), question, precision));
        return SlopeSearch(std::move(field), furthest);
    }

    /// Samples several views, then climbs from the three steepest samples.
    Steep steepest(const std::vector<FrameState>& views) {
        constexpr size_t k_climbs = 3;
        std::vector<Steep> starts;
        for (const FrameState& view : views)
            starts.push_back(steepest_in(whole_, view));
        std::ranges::sort(starts, steeper);
        starts.resize(std::min(starts.size(), k_climbs));
        for (Steep& start : starts)
            start = climbed(start);
        return std::ranges::min(starts, steeper);
    }

    /// Climbs by sampling windows around the best place so far, each half as wide as the one before.
    Steep climbed(Steep best) {
        constexpr int k_halvings = 8;
        double part = 1.0 / 32;
        for (int round = 0; round < k_halvings; ++round, part /= 2)
            best = std::min(best, steepest_in(around(best, whole_, part), best.view), steeper);
        return best;
    }

private:
    SlopeSearch(FieldBench field, double furthest) : field_(std::move(field)) { whole_.far = furthest; }

    Steep steepest_in(const Window& window, const FrameState& view) {
        const double step = 2e-5 * whole_.far;
        const image::Image image = field_.ask(
            {{window.low.x, window.low.y, window.high.x, window.high.y}, {window.near, window.far}, {step}},
            view);
        Steep best{.view = view};
        for (size_t i = 0; i < image.extent.pixels(); ++i) {
            const auto hit = image.f32().subspan(4 * i, 4);
            if (double(hit[3]) > best.slope)
                best = {double(hit[3]), double(hit[2]), {hit[0], hit[1]}, view};
        }
        return best;
    }

    FieldBench field_;
    Window whole_;
};

std::vector<FrameState> views_over_time() {
    std::vector<FrameState> views;
    for (const double time : {1.0, 10.0, 100.0})
        for (FrameState view : usual_views()) {
            view = render::at_time(time, view);
            views.push_back(view);
        }
    return views;
}

/// Returns the largest distance of a hit; 0 if no ray hits.
Result<double> furthest_of(ProbeBench& bench, const std::vector<FrameState>& views) {
    double furthest = 0;
    for (const FrameState& view : views) {
        const auto hits = TRY(bench.hits(view));
        for (const double distance : hits.distance)
            furthest = std::max(furthest, distance); // a NaN compares as false and is skipped
    }
    return furthest;
}

Result<image::Image> map_of(ProbeBench& bench, const Steep& place) {
    const auto hits = TRY(bench.hits(place.view));
    const auto pixel = size_t(std::min(place.pixel.y, k_ray_extent.height - 1.0)) * k_ray_extent.width +
                       size_t(std::min(place.pixel.x, k_ray_extent.width - 1.0));
    return ray_map(hits, k_ray_extent, [pixel](size_t i) { return i == pixel; });
}

/// Tolerance for fields in float, whose rounding looks like a slope over so short a step.
constexpr double k_float_slack = 1.05;
constexpr std::string_view k_too_long = ": steps that rely on that bound are too long";

std::string bound_of(double stated) {
    return std::isinf(stated) ? ", where the scene states no bound (largest_slope in NAME.check.json),"
                              : fmt::format(", where the scene states at most {:g},", stated);
}

std::string place_of(const Steep& found) {
    return fmt::format(" at {:g} s, pixel {:.2f},{:.2f}, distance {:.4g}", found.view.seconds(),
                       found.pixel.x, found.pixel.y, found.distance);
}

/// Compares a slope with the bound that the scene states; `slack` is the factor that rounding may add.
Result<Answer> judged(ProbeBench& bench, const std::string& seen, const Steep& found, double slack) {
    const double stated = bench.promises().largest_slope;
    Answer answer{Verdict::pass, seen + bound_of(stated) + place_of(found)};
    if (found.slope > stated * slack) {
        answer.verdict = Verdict::fail;
        answer.sentence += k_too_long;
        answer.where = found.view;
        answer.picture = TRY(map_of(bench, found));
    }
    return answer;
}

/// Checks a recorded march by how much its distance falls per unit between two samples. The field has at
/// least that slope somewhere between them.
Result<Answer> ask_recorded_march(ProbeBench& bench) {
    if (const std::string& problem = bench.recording_problem(); !problem.empty())
        return Answer{Verdict::not_applicable,
                      "the scene has no march_field, and its march is not recorded: " + problem};
    if (!bench.recording_sees_below())
        return without_sign();
    Steep found;
    for (const FrameState& view : views_over_time()) {
        const auto falls = TRY(bench.recorded(view, glsl::RecordAnswer::fall));
        for (int i = 0; i < int(falls.extent.pixels()); ++i)
            if (const auto fall = falls.f32().subspan(size_t(4 * i), 4); double(fall[0]) > found.slope) {
                const int row = i / view.extent.width;
                found = {double(fall[0]), double(fall[1]), {i % view.extent.width + 0.5, row + 0.5}, view};
            }
    }
    return judged(
        bench,
        fmt::format("the distance falls by up to {:.3g} per unit between two samples of a ray", found.slope),
        found, k_float_slack);
}

} // namespace

Result<Answer> ask_gradient(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    if (!bench.has_main_hit() || !has_march_field(bench.scene()))
        return ask_recorded_march(bench);
    const std::vector<FrameState> views = views_over_time();
    const auto furthest = TRY(furthest_of(bench, views));
    if (furthest == 0 || std::isinf(furthest))
        return Answer{Verdict::not_applicable, "no ray hits the surface"};
    auto search = SlopeSearch::create(bench, furthest, glsl::Precision::single);
    if (!search)
        return Answer{Verdict::not_applicable,
                      "the field does not compile on its own: " + to_string(search.error())};
    Steep found = search->steepest(views);
    const double stated = bench.promises().largest_slope;
    double slack = k_float_slack;
    if (found.slope > stated)
        if (auto exact = SlopeSearch::create(bench, furthest, glsl::Precision::promoted)) {
            found.slope = -1;
            found = exact->climbed(found);
            slack = 1.001;
        }
    return judged(bench, fmt::format("the field's slope along a ray reaches {:.3g}", found.slope), found,
                  slack);
}

// Checks the slopes that differences of the field give, as used for normals. For scenes with a mainHit whose
// field is the march_field of shaders/lib/march.glsl, and for marches known from the text.

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
                fmt::format(
                    "every slope over the scene's own step {:g} is NaN or infinite; the best step is {:g}",
                    step, best_step),
                typical_view()};
        if (*angle > k_visible_angle)
            return Answer{fault(bench),
                          fmt::format("over the scene's own step {:g} half of the slopes along the rays are "
                                      "off by {:.2g} degrees or more; the best step is {:g}",
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
    return {
        best > k_visible_angle ? Verdict::warn : Verdict::pass,
        fmt::format(
            "slopes by differences of the field are off by {:.2g} degrees at best, over {:g} (medians: {})",
            best, best_step, range)};
}

Result<Answer> ask_march_field(ProbeBench& bench) {
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
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + field.error().message};
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
    return bench.has_main_hit() && has_march_field(bench.scene()) ? ask_march_field(bench)
                                                                  : ask_recorded(bench);
}

} // namespace tidemark::lab
