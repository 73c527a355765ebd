#include "lab/probed_rays.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/pass_function.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tidemark::lab {
namespace {

bool parts(double here, double there, Extent extent) {
    if (std::isnan(here) || std::isnan(there))
        return std::isnan(here) != std::isnan(there);
    if (here < 0 || there < 0)
        return (here < 0) != (there < 0);
    return std::abs(here - there) > std::max(here, there) / extent.height;
}

} // namespace

std::vector<FrameState> usual_views() {
    const FrameState untouched = state_at(10, k_ray_extent);
    std::vector<FrameState> views{untouched};
    for (const glm::dvec2 at : {glm::dvec2(0.5, 0.5), glm::dvec2(0.75, 0.4), glm::dvec2(0.3, 0.47)})
        views.push_back(with_mouse(
            render::Mouse::clicked(at * glm::dvec2(k_ray_extent.width, k_ray_extent.height), false),
            untouched));
    return views;
}

FrameState typical_view() {
    return usual_views()[2];
}

double percent(const Hits& hits, const std::function<bool(size_t)>& counts) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        count += counts(i);
    return 100.0 * double(count) / double(std::max<size_t>(hits.size(), 1));
}

double flagged(const Hits& hits, glsl::HitFlag flag) {
    return percent(hits, [&](size_t i) { return (hits.flags[i] & flag) != 0; });
}

double unanswered(const Hits& hits) {
    return percent(hits, [&](size_t i) { return std::isnan(hits.distance[i]); });
}

double mean_evaluations(const Hits& hits) {
    return std::accumulate(hits.evaluations.begin(), hits.evaluations.end(), 0.0) /
           double(std::max<size_t>(hits.size(), 1));
}

image::Image ray_map(const Hits& hits, Extent extent, const std::function<bool(size_t)>& marks) {
    double nearest = 1e30;
    for (const double distance : hits.distance)
        if (distance > 0)
            nearest = std::min(nearest, distance);
    image::Image map(extent, 3, image::SampleType::f32);
    for (size_t i = 0; i < hits.size(); ++i) {
        const double distance = hits.distance[i];
        const bool marked = std::isnan(distance) || marks(i);
        const float grey = marked || !(distance > 0) ? 0.0f : float(std::sqrt(nearest / distance));
        const float shown[] = {marked ? 1.0f : grey, grey, marked ? 1.0f : grey};
        std::ranges::copy(shown, map.f32().begin() + std::ptrdiff_t(3 * i));
    }
    return map;
}

namespace {

constexpr float k_step_of_8_bits = 1.0f / 255;

/// Returns for each pixel whether a colour, limited to what a screen shows, changes visibly.
std::vector<bool> changes(const image::Image& before, const image::Image& after) {
    std::vector<bool> changed(before.extent.pixels());
    for (size_t i = 0; i < changed.size(); ++i)
        for (size_t k = 4 * i; k < 4 * i + 3; ++k) {
            const float one = std::clamp(before.f32()[k], 0.0f, 1.0f),
                        other = std::clamp(after.f32()[k], 0.0f, 1.0f);
            changed[i] = changed[i] || !(std::abs(one - other) <= k_step_of_8_bits);
        }
    return changed;
}

Result<RunningOut> running_out(ProbeBench& bench, const FrameState& view) {
    const Hits hits = TRY(bench.hits(view));
    const double all = flagged(hits, glsl::k_hit_exhausted);
    std::vector<bool> before_hit(hits.size());
    for (size_t i = 0; i < hits.size(); ++i)
        before_hit[i] = (hits.flags[i] & glsl::k_hit_exhausted) != 0;
    if (all > 0 && bench.recording_problem().empty()) {
        const Hits longer = hits_of(TRY(bench.recorded(view, glsl::RecordAnswer::hit_with_more)));
        const std::vector<bool> shows =
            changes(TRY(bench.recorded(view, glsl::RecordAnswer::picture)),
                    TRY(bench.recorded(view, glsl::RecordAnswer::picture_with_more)));
        for (size_t i = 0; i < hits.size(); ++i) {
            const bool past = bench.sees_below() && (hits.flags[i] & glsl::k_hit_negative) != 0;
            before_hit[i] = before_hit[i] && (past || (longer.distance[i] >= 0 && shows[i]));
        }
    }
    const auto counts = [&](size_t i) { return before_hit[i]; };
    const double share = percent(hits, counts);
    return RunningOut{share, all - share, mean_evaluations(hits), view, ray_map(hits, view.extent, counts)};
}

} // namespace

Result<RunningOut> most_running_out(ProbeBench& bench, const std::vector<FrameState>& views) {
    RunningOut most{.percent = -1};
    for (const FrameState& view : views)
        if (RunningOut found = TRY(running_out(bench, view));
            std::pair(found.percent, found.of_none) > std::pair(most.percent, most.of_none))
            most = std::move(found);
    return most;
}

double most_allowed(const ProbeBench& bench, double promised, const std::string& name) {
    const bool stated = bench.has_main_hit() || bench.promises().stated.contains(name);
    return stated ? promised : std::max(promised, k_most_wrong_percent);
}

std::string allowed(double promised) {
    return fmt::format("; allowed: {:g} % (change it in NAME.check.json)", promised);
}

Answer running_out_answer(ProbeBench& bench, RunningOut most, std::string_view views,
                          std::string_view probe) {
    Answer answer{Verdict::pass,
                  fmt::format("{:.3g} % of the rays run out of steps before they hit, in the worst of {}, "
                              "{:.3g} samples a ray",
                              most.percent, views, most.evaluations)};
    if (most.of_none > 0)
        answer.sentence += fmt::format("; {:.3g} % run out where more steps change nothing", most.of_none);
    const double promised =
        most_allowed(bench, bench.promises().most_exhausted_percent, "most_exhausted_percent");
    if (!(most.percent > promised))
        return answer;
    if (const std::string_view reported = bench.running_out_reported();
        !reported.empty() && (reported != "turns" || !bench.has_main_hit()))
        return {Verdict::not_applicable, fmt::format("{}: see {}", answer.sentence, reported)};
    bench.report_running_out(probe);
    answer.verdict = bench.has_main_hit() ? Verdict::fail : Verdict::warn;
    answer.sentence += allowed(promised);
    if (const auto& image = bench.image_function(); image && !image->loops().empty()) {
        const proof::MarchingLoop& loop = image->loops().front();
        add_place(answer, image->locate(loop.line));
        if (loop.hands_on && !bench.has_main_hit())
            answer.verdict = Verdict::note;
        if (loop.turns) {
            answer.effect = "rays run out of iterations before they hit anything";
            answer.cause = fmt::format("the loop ends after {} iterations", *loop.turns);
            if (!bench.has_main_hit())
                answer.cause += fmt::format("; with up to {} they hit", 4 * *loop.turns);
        }
    } else if (bench.has_main_hit()) {
        const scene::Scene& scene = bench.scene();
        if (const auto where = glsl::PassReading(scene, scene.image()).place_of("mainHit"))
            add_place(answer, *where);
    }
    answer.where = most.where;
    answer.picture = std::move(most.map);
    return answer;
}

Answer without_hits(const ProbeBench& bench, bool warns) {
    const std::string why = "the march is not recorded: " + bench.hit_problem();
    if (bench.main_hit_problem().empty())
        return {Verdict::not_applicable, "no mainHit, and " + why};
    const std::string broken = "mainHit does not compile: " + bench.main_hit_problem();
    return warns ? Answer{.verdict = Verdict::warn, .sentence = broken + "; " + why, .effect = broken}
                 : Answer{Verdict::not_applicable, "mainHit does not compile: see overstep"};
}

Answer without_sign() {
    return {
        Verdict::not_applicable,
        "the march has fixed steps or waits for a sample below the surface, so such a sample is no fault"};
}

Verdict fault(const ProbeBench& bench) {
    return bench.has_main_hit() ? Verdict::fail : Verdict::note;
}

Result<FloatMismatch> float_mismatch(ProbeBench& bench, const FrameState& state) {
    auto in_float = TRY(bench.hits(state));
    auto in_double = TRY(bench.hits(state, glsl::Precision::promoted));
    FloatMismatch both{std::move(in_float), std::move(in_double), {}, 0, {}};
    for (size_t i = 0; i < both.in_float.size(); ++i)
        both.mismatched.push_back(parts(both.in_float.distance[i], both.in_double.distance[i], state.extent));
    const auto marks = [&](size_t i) { return both.mismatched[i]; };
    both.mismatched_percent = percent(both.in_float, marks);
    both.map = ray_map(both.in_float, state.extent, marks);
    return both;
}

Result<FlaggedRays> most_flagged(ProbeBench& bench, glsl::HitFlag flag) {
    FlaggedRays most{.percent = -1};
    for (const FrameState& view : usual_views()) {
        const auto hits = TRY(bench.hits(view));
        if (const double share = flagged(hits, flag); share > most.percent)
            most = {share, view,
                    ray_map(hits, view.extent, [&](size_t i) { return (hits.flags[i] & flag) != 0; })};
    }
    return most;
}

namespace {

constexpr Extent k_rays{16, 9};
/// Most field evaluations for all rays of a moment; a field with seven octaves takes some seconds for them.
constexpr uint64_t k_most_of_all = 50'000;

/// Returns the pixel of the i-th ray. The first rays are evenly spread over the picture, however many are
/// used.
glm::ivec2 pixel_of(size_t i, Extent whole) {
    const auto at = int(spread(i, k_rays.pixels()));
    const int x = at % k_rays.width, y = at / k_rays.width;
    return {(2 * x + 1) * whole.width / (2 * k_rays.width), (2 * y + 1) * whole.height / (2 * k_rays.height)};
}

} // namespace

void look_at_rays(Extent whole, const std::function<uint64_t(glm::ivec2 pixel)>& look) {
    uint64_t left = k_most_of_all;
    for (size_t i = 0; i < k_rays.pixels() && left > 0; ++i)
        left -= std::min<uint64_t>(left, look(pixel_of(i, whole)));
}

Result<std::optional<MarchingPass>> marching_pass(ProbeBench& bench) {
    std::vector<size_t> passes{bench.scene().image_index()};
    for (const render::PlannedPass& planned : TRY(bench.compiled())->plan().passes)
        passes.push_back(planned.pass);
    for (const size_t pass : passes) {
        const auto& function = bench.function_of(pass);
        if (function && !function->loops().empty())
            return MarchingPass{pass, &*function};
    }
    return std::nullopt;
}

Answer without_march(ProbeBench& bench) {
    const auto& image = bench.image_function();
    return {Verdict::not_applicable, image ? "no ray-marching loop found in any pass"
                                           : "the text cannot be analysed: " + image.error().message};
}

Result<RayCounts> count_proved(ProbeBench& bench, const MarchingPass& pass) {
    const PassFunction& function = *pass.function;
    RayCounts counts;
    for (const double moment : k_ray_moments) {
        const FrameState state = state_at(moment);
        const render::Renderer& renderer = *TRY(bench.drawn(state));
        const proof::TextureSet textures = textures_of(renderer, pass.index);
        proof::FloatEvaluator pixel = function.frame(renderer, pass.index, render::inputs_of(state));
        look_at_rays(renderer.extent(), [&](glm::ivec2 at) -> uint64_t {
            function.move_to(pixel, at);
            const auto ray = prove_ray(function, pixel, textures, at, k_most_of_a_ray);
            if (!ray)
                return 0;
            counts.add(*ray);
            return ray->evaluations;
        });
    }
    return counts;
}

double wrong_percent(const RayCounts& counts) {
    const size_t wrong = counts.step_over + counts.miss;
    return wrong == 0 ? 0 : 100.0 * double(wrong) / double(counts.decided());
}

namespace {

constexpr Extent k_grid{16, 9};
constexpr double k_narrow_gap = 1e-6;

double parameter(const proof::MarchSlice& slice, double units) {
    return slice.start() + units / slice.unit();
}

} // namespace

Result<FieldOnRays> FieldOnRays::create(ProbeBench& bench, const FrameState& state) {
    const auto& function = bench.image_function();
    if (!function)
        return fail(function.error());
    const render::Renderer& renderer = *TRY(bench.drawn(state));
    FieldOnRays field({*function, renderer, bench.scene().image_index(), inputs_of(state)});
    for (int y = 0; y < k_grid.height; ++y)
        for (int x = 0; x < k_grid.width; ++x) {
            const glm::ivec2 pixel{(2 * x + 1) * renderer.extent().width / (2 * k_grid.width),
                                   (2 * y + 1) * renderer.extent().height / (2 * k_grid.height)};
            auto ray = field.source_->enter(pixel, proof::Surface::zero);
            if (ray && ray->slice && !ray->march.turns.empty() && std::isfinite(ray->slice->start()))
                field.rays_.push_back(*std::move(ray));
        }
    return field;
}

std::optional<double> FieldOnRays::hit(size_t ray) const {
    const auto& [loop, march, slice, in_float] = rays_[ray];
    return march.hit ? std::optional((slice->parameter(march.turns.back()) - slice->start()) * slice->unit())
                     : std::nullopt;
}

double FieldOnRays::longest(size_t ray) const {
    double longest = 0;
    for (const proof::Turn& turn : rays_[ray].march.turns)
        if (std::isfinite(turn.distance()))
            longest = std::max(longest, std::abs(double(turn.distance())));
    return longest;
}

std::optional<double> FieldOnRays::in_float(size_t ray, double units) {
    return rays_[ray].in_float->distance(parameter(*rays_[ray].slice, units));
}

std::optional<double> FieldOnRays::exact(size_t ray, double units) {
    proof::MarchSlice& slice = *rays_[ray].slice;
    const auto found = slice.distance(proof::place_at(parameter(slice, units)), proof::Care::close);
    if (!found || found->partial)
        return std::nullopt;
    const double middle = found->low + found->width() / 2;
    return found->width() <= k_narrow_gap * std::max(1.0, std::abs(middle)) ? std::optional(middle)
                                                                            : std::nullopt;
}

} // namespace tidemark::lab
