// Compares the slope bound that a solver's steps rely on with the largest slope that a search finds. For
// scenes with a mainHit whose field is the march_field of shaders/lib/march.glsl, and for recorded marches.
#include "base/try.hpp"
#include "lab/check/field_bench.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
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
    return std::isinf(stated) ? "; the scene states no bound (largest_slope in NAME.check.json),"
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
    if (!bench.sees_below())
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
        fmt::format("the distance falls by up to {:.3g} a unit between two samples of a ray", found.slope),
        found, k_float_slack);
}

} // namespace

Result<Answer> ask_gradient(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    if (!bench.has_main_hit())
        return ask_recorded_march(bench);
    if (!has_march_field(bench.scene()))
        return Answer{Verdict::not_applicable, "the scene has no march_field to take slopes of"};
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

} // namespace tidemark::lab
