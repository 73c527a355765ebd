// Checks that need no mainHit: they prove facts about a scene's rays from its text alone.

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/march_rays.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/text_findings.hpp"
#include "proof/ray_proofs.hpp"
#include "shader/fixes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

double percent_of(size_t part, size_t all) {
    return all == 0 ? 0 : 100.0 * double(part) / double(all);
}

Answer no_answer(std::string why) {
    return {Verdict::not_applicable, std::move(why)};
}

std::string advice_of(const proof::MarchingLoop& loop, const RayCounts& counts) {
    if (!counts.steps_too_long())
        return "take more steps";
    return !loop.stops_before && counts.step_over > 0 && counts.within_last_step == counts.step_over &&
                   counts.went_past == 0
               ? "look for the hit between the last two samples, or take shorter steps"
               : "take shorter steps";
}

std::string sentence_of(const PassFunction& function, const RayCounts& counts) {
    std::string text =
        fmt::format("{2:.3g} % of the decided rays step over their first hit by more than {4:g} % of the "
                    "distance, {3:.3g} % miss it; {0:.3g} % of {1} rays are decided",
                    percent_of(counts.decided(), counts.rays), counts.rays,
                    percent_of(counts.step_over, counts.decided()), percent_of(counts.miss, counts.decided()),
                    100 * k_same_end);
    if (counts.undecided > 0)
        text += fmt::format(", {:.3g} % are not ({})", percent_of(counts.undecided, counts.rays),
                            to_string(counts.commonest()));
    if (counts.at_base_level > 0)
        text += fmt::format("; for {:.3g} % of the rays a texture is read at its base level, where the "
                            "device would choose a mipmap",
                            percent_of(counts.at_base_level, counts.rays));
    if (counts.wrong_loop) {
        const proof::MarchingLoop& loop = function.loops()[*counts.wrong_loop];
        const SourceLocation where = function.locate(loop.line);
        text +=
            fmt::format("; {}:{} tests the distance: {}", where.file, where.line, advice_of(loop, counts));
    }
    return text;
}

/// A colour changes for a viewer if it differs by more than this; rounding and banding differ by less.
constexpr float k_seen = 0.03f;

/// Returns the percentage of the pixels whose colour, limited to what a screen shows, differs for a viewer.
double seen_percent(const image::Image& before, const image::Image& after) {
    const auto channels = size_t(before.channels);
    size_t count = 0;
    for (size_t i = 0; i < before.samples(); i += channels) {
        bool differs = false;
        for (size_t k = i; k < i + channels; ++k)
            differs = differs || std::abs(std::clamp(before.f32()[k], 0.0f, 1.0f) -
                                          std::clamp(after.f32()[k], 0.0f, 1.0f)) > k_seen;
        count += differs;
    }
    return percent_of(count, before.extent.pixels());
}

/// Returns whether a viewer sees another picture if the march takes a quarter of its steps' length, and four
/// times as many; true if the text cannot be changed so.
Result<bool> shorter_steps_show(ProbeBench& bench, const MarchingPass& pass,
                                const proof::MarchingLoop& loop) {
    constexpr double k_quarter = 0.25;
    const auto texts = read_texts(bench, true);
    const auto lines = lines_of(*pass.function, loop);
    if (!texts)
        return true;
    for (const PassText& text : *texts) {
        if (text.pass != pass.index)
            continue;
        const auto cures = glsl::shorter_steps(*text.text, {lines.test, lines.updates}, k_quarter);
        const bool longer = !cures.empty() && cures.front().reason.find("iterations") != std::string::npos;
        const auto scene =
            longer || !loop.turns
                ? changed(bench.scene(), std::span(cures).first(std::min<size_t>(1, cures.size())))
                : std::nullopt;
        if (cures.empty() || !scene)
            return true;
        ProbeBench finer(*scene, bench.promises());
        for (const double moment : k_ray_moments) {
            const FrameState state = state_at(moment, k_ray_extent);
            const auto after = finer.picture(state);
            if (!after || seen_percent(TRY(bench.picture(state)), *after) > k_most_wrong_percent)
                return true;
        }
        return false;
    }
    return true;
}

/// Returns why wrong first hits do not make a wrong picture; empty: they do, or that is not known.
Result<std::string_view> why_unseen(ProbeBench& bench, const MarchingPass& pass, const RayCounts& counts) {
    const proof::MarchingLoop& loop = pass.function->loops()[*counts.wrong_loop];
    if (loop.hands_on)
        return "another loop goes on from the march's end, so that it is a bound and no surface";
    if (loop.accumulates)
        return "the loop also adds up what it meets, such as a glow or a density, so its end need not be a "
               "surface";
    if (!TRY(shorter_steps_show(bench, pass, loop)))
        return "with steps of a quarter the picture looks the same";
    return std::string_view();
}

} // namespace

Result<Answer> ask_first_hit(ProbeBench& bench) {
    const auto pass = TRY(marching_pass(bench));
    if (!pass)
        return without_march(bench);
    const RayCounts counts = TRY(count_proved(bench, *pass));
    if (counts.rays == 0)
        return no_answer("no ray reaches the marching loop");
    if (counts.unknown_texture == counts.rays)
        return no_answer("the march reads the previous frame, or a texture that is too large");
    if (counts.unfaithful == counts.rays)
        return no_answer("the march keeps more state than its place on the ray");
    if (counts.decided() == 0)
        return no_answer(
            fmt::format("none of {} rays is decided: {}", counts.rays, to_string(counts.commonest())));
    if (counts.contradicted > 0)
        return no_answer(
            fmt::format("{} rays contradict their proof: please report this scene", counts.contradicted));
    const double wrong = wrong_percent(counts);
    Answer answer{wrong > k_wrong_percent_of_failure ? Verdict::fail
                  : wrong > k_most_wrong_percent     ? Verdict::note
                                                     : Verdict::pass,
                  sentence_of(*pass->function, counts)};
    if (counts.wrong_loop)
        add_place(answer, pass->function->locate(pass->function->loops()[*counts.wrong_loop].line));
    if (answer.verdict == Verdict::fail)
        if (const std::string_view why = TRY(why_unseen(bench, *pass, counts)); !why.empty()) {
            answer.verdict = Verdict::note;
            answer.sentence += fmt::format("; {}", why);
        }
    if (counts.step_over == 0)
        answer.effect = "rays end before they reach a surface: the march has too few iterations";
    return answer;
}

namespace {

/// Most evaluations for the scale of one ray, in addition to those for its first hit.
constexpr uint64_t k_most_for_scale = 400;
/// Most evaluations for all areas of a picture.
constexpr uint64_t k_most_of_areas = 20'000;
/// Factor that allows for rounding in steps as long as the distance.
constexpr double k_rounded = 1.001;

/// Percent of the rays on which the march's usual step may pass the hit.
constexpr double k_most_too_long_percent = 5;
/// A bound of the slope says something if it is at most this multiple of the slopes found at samples.
constexpr double k_close_bound = 2;

struct OwnSteps {
    std::vector<double> scales{}; ///< steps as multiples of the distances for which they were taken
    double fall = 0;              ///< the largest at a sample by which the distance falls per unit
};

void add_own(proof::MarchSlice& slice, const proof::March& march, OwnSteps& own) {
    for (size_t i = 0; i + 1 < march.turns.size(); ++i) {
        const double at = slice.parameter(march.turns[i]);
        const auto distance = slice.distance(proof::place_at(at), proof::Care::close);
        if (!distance || !(distance->low > 0))
            continue;
        own.scales.push_back((slice.parameter(march.turns[i + 1]) - at) * slice.unit() / distance->low);
        if (const auto tangent = slice.tangent(proof::place_at(at)))
            own.fall = std::max(own.fall, -tangent->slope.high / slice.unit());
    }
}

struct Scales {
    size_t hits = 0;              ///< rays whose first hit is proved
    std::vector<double> safe{};   ///< of those rays with a known scale
    std::vector<double> unsafe{}; ///< of all of those rays
    OwnSteps own{};               ///< of the march on those rays
    /// The scale with the smallest unsafe multiple, and the ray it was found on.
    proof::StepScale least{.safe = proof::k_longest_scale};
    size_t loop = 0;
    glm::ivec2 pixel{0};
    FrameState state{};
    AreaSlopes areas{}; ///< over the whole picture, between the rays too

    bool bounded() const { return 2 * safe.size() > hits; } ///< known on most of the rays
    /// Returns the percentage of the rays on which the march's usual step passes the hit.
    double too_long_percent() const {
        const double usual = median(own.scales);
        const auto too_long =
            std::ranges::count_if(unsafe, [&](double each) { return usual > each * k_rounded; });
        return percent_of(size_t(too_long), hits);
    }
};

/// Adds one ray; returns the evaluations it took.
uint64_t add(MarchRay& ray, glm::ivec2 pixel, const FrameState& state, Scales& scales) {
    proof::MarchSlice& slice = *ray.slice;
    const double last = slice.end(ray.march);
    if (last < slice.start())
        return 0;
    const proof::FirstHit hit = proof::first_hit(slice, last, k_most_of_a_ray);
    if (hit.verdict != proof::FirstHit::Verdict::hit)
        return slice.evaluations();
    ++scales.hits;
    add_own(slice, ray.march, scales.own);
    const proof::StepScale scale = proof::step_scale(slice, hit.where, k_most_for_scale);
    if (scale.safe > 0)
        scales.safe.push_back(scale.safe);
    scales.unsafe.push_back(scale.unsafe);
    if (scale.unsafe < scales.least.unsafe) {
        scales.least = scale;
        scales.loop = ray.loop;
        scales.pixel = pixel;
        scales.state = state;
    }
    return slice.evaluations();
}

Result<Scales> scales_of(ProbeBench& bench, const MarchingPass& pass) {
    Scales scales;
    for (const double moment : k_ray_moments) {
        const FrameState state = state_at(moment);
        const render::Renderer& renderer = *TRY(bench.drawn(state));
        const MarchRays rays({*pass.function, renderer, pass.index, render::inputs_of(state)});
        look_at_rays(renderer.extent(), [&](glm::ivec2 pixel) -> uint64_t {
            auto ray = rays.enter(pixel, proof::Surface::zero);
            const bool marches = ray && ray->slice && !ray->march.turns.empty();
            return marches ? add(*ray, pixel, state, scales) : 0;
        });
        scales.areas.add(area_slopes(rays, k_most_of_areas));
    }
    return scales;
}

/// Describes the slopes over all rays of a picture, not only the sampled ones. Leaves out bounds that are far
/// above the slopes that were found.
std::string areas_sentence(const AreaSlopes& areas, double found) {
    const double way = areas.way(), bounded = areas.bounded_way();
    if (!(way > 0))
        return {};
    std::string text = fmt::format(
        "; between the rays the slope is bounded on {:.3g} % of the way to the surface", 100 * bounded / way);
    const auto tells = [&](double falls) {
        return bounded > 0 && falls > 0 && falls <= k_close_bound * found;
    };
    const double most = areas.falls_on(1), on_most = areas.falls_on(0.95);
    if (tells(most))
        text += fmt::format(": the distance falls by at most {:.3g} per unit", most);
    else if (tells(on_most))
        text += fmt::format(": on 95 % of it the distance falls by at most {:.3g} per unit", on_most);
    else
        return {};
    if (areas.may_jump > 0)
        text += fmt::format(", apart from possible jumps on {:.3g} %", 100 * areas.may_jump / way);
    if (areas.not_finite > 0)
        text += fmt::format("; on {:.3g} % it may be NaN or infinite", 100 * areas.not_finite / way);
    return text;
}

std::string scales_sentence(const Scales& scales) {
    const size_t unknown = scales.hits - scales.safe.size();
    const double own = median(scales.own.scales);
    std::string text;
    if (scales.bounded())
        text = fmt::format(
            "steps of {:.2g} x the distance are safe on {} rays that hit, {:.2g} x on 95 % of them",
            std::ranges::min(scales.safe), scales.safe.size(), quantile(scales.safe, 0.05));
    if (unknown > 0)
        text += fmt::format("{}on {} of {} rays the field cannot be bounded", text.empty() ? "" : "; ",
                            unknown, scales.hits);
    if (own > scales.least.unsafe * k_rounded)
        text += fmt::format(
            "; a step of {:.2g} x from {:.4g} passes the hit, on the ray of pixel {},{} at {:g} s",
            scales.least.unsafe, scales.least.at, scales.pixel.x, scales.pixel.y, scales.state.seconds());
    text += fmt::format("; the march's own steps are {:.2g} x in the median", own);
    if (const double too_long = scales.too_long_percent(); too_long > 0)
        text += fmt::format(", too long on {:.3g} % of the rays", too_long);
    return text + areas_sentence(scales.areas, scales.own.fall);
}

} // namespace

Result<std::optional<double>> safe_step(ProbeBench& bench, const MarchingPass& pass) {
    const Scales scales = TRY(scales_of(bench, pass));
    return scales.bounded() ? std::optional(std::ranges::min(scales.safe)) : std::nullopt;
}

Result<Answer> ask_step_scale(ProbeBench& bench) {
    const auto pass = TRY(marching_pass(bench));
    if (!pass)
        return without_march(bench);
    const std::vector<proof::MarchingLoop>& loops = pass->function->loops();
    const auto fixed = [](const proof::MarchingLoop& loop) {
        return loop.kind == proof::MarchingLoop::Kind::fixed_step;
    };
    if (std::ranges::all_of(loops, fixed))
        return no_answer("the march's steps do not depend on the distance");
    const Scales scales = TRY(scales_of(bench, *pass));
    if (scales.hits == 0)
        return no_answer("no ray is proved to reach a zero of the distance");
    // A march that waits for a sample below the surface returns from it, so its steps are never too long.
    // On single rays the field may jump.
    const bool too_long =
        loops[scales.loop].stops_before && scales.too_long_percent() > k_most_too_long_percent;
    if (!scales.bounded() && !too_long)
        return no_answer(scales_sentence(scales));
    Answer answer{too_long ? Verdict::note : Verdict::pass, scales_sentence(scales)};
    add_place(answer, pass->function->locate(loops[scales.loop].line));
    if (too_long)
        answer.where = scales.state;
    return answer;
}

// Checks whether rays run out of their march's iterations: in float, and by proved bounds from the least
// length of each step.

namespace {

/// Most evaluations for the bound of one ray, or of one ray over a span of time.
constexpr uint64_t k_most_of_a_bound = 500;
/// The checked span in seconds, and the shortest part that it is divided into.
constexpr proof::Interval k_span{0, 10};
constexpr double k_shortest_span = 10.0 / 16;
/// One in so many rays is checked over the span.
constexpr size_t k_every = 4;
/// A march without a limit is ended by a wall; it is looked for up to this multiple of the way to the last
/// iteration.
constexpr double k_behind = 2;
/// A ray that runs out is marched again with up to this many times the loop's iterations.
constexpr uint32_t k_longer_loop = 4;
/// Most such iterations for all rays of a moment.
constexpr uint64_t k_most_longer = 40'000;
/// Below the surface by more than rounding.
constexpr float k_surely_past = -1e-5f;
/// Share of the steps of a march that go back if it moves to and fro. Over-relaxed marches go back less
/// often.
constexpr double k_to_and_fro = 0.25;

struct TurnCounts {
    size_t rays = 0;
    size_t out = 0;         ///< run out before a hit that shows
    size_t out_of_none = 0; ///< run out, and more iterations find no hit or change no colour
    size_t past = 0;        ///< of `out`: the march was past the surface, so its steps are too long
    size_t looked_at = 0, proved = 0, contradicted = 0; ///< of the rays to bound
    size_t unfollowed = 0; ///< their step is not one value that each iteration adds
    size_t needed = 0;     ///< most iterations of a march that does not run out
    uint32_t turns = 0;
    size_t rays_over_time = 0;
    double proved_seconds = 0; ///< sum over those rays
    glm::ivec2 pixel{0};       ///< of the first ray that runs out
    FrameState state{};
    int line = 0;
    bool hands_on = false; ///< proof::MarchingLoop::hands_on
};

double share(double some, double all) {
    return all == 0 ? 0 : 100 * some / all;
}

class TurnLook {
public:
    TurnLook(const MarchRays& rays, const FrameState& state, TurnCounts& counts)
        : rays_(rays), state_(state), counts_(counts) {}

    /// Follows a ray in float and counts it.
    void follow(glm::ivec2 pixel) {
        const auto ray = longer_ < k_most_longer ? enter(pixel) : std::nullopt;
        if (!ray)
            return;
        const proof::MarchingLoop& loop = loop_of(*ray);
        ++counts_.rays;
        counts_.turns = std::max(counts_.turns, *loop.turns);
        if (runs_out(*ray, loop))
            add_out(pixel, *ray, loop);
        else
            counts_.needed = std::max(counts_.needed, ray->march.turns.size());
    }

    /// Bounds the iterations of a ray and counts the result; returns the evaluations it took.
    uint64_t bound(glm::ivec2 pixel) {
        const auto ray = enter(pixel);
        if (!ray)
            return 0;
        const proof::MarchingLoop& loop = loop_of(*ray);
        const bool out = runs_out(*ray, loop);
        ++counts_.looked_at;
        counts_.unfollowed += !out && (!ray->slice || loop.advance == proof::k_no_value);
        if (!ray->slice)
            return 1;
        used_ = 0;
        const proof::March& march = ray->march;
        const double end = march.far ? *march.far : behind(*ray->slice, march);
        const auto most = bound({at(pixel.x), at(pixel.y)}, ray->loop, end);
        counts_.proved += most.has_value();
        counts_.contradicted += most && (out || *most < march.turns.size());
        if (!out && number_++ % k_every == 0) {
            ++counts_.rays_over_time;
            counts_.proved_seconds += most ? proved_of(pixel, k_span, ray->loop, end) : 0;
        }
        return used_;
    }

private:
    const proof::MarchingLoop& loop_of(const MarchRay& ray) const {
        return rays_.function().loops()[ray.loop];
    }

    /// Returns the ray if its loop steps by a distance and counts its iterations.
    std::optional<MarchRay> enter(glm::ivec2 pixel) const {
        auto ray = rays_.enter(pixel, proof::Surface::threshold);
        if (!ray || ray->march.turns.empty() || !loop_of(*ray).turns ||
            loop_of(*ray).kind == proof::MarchingLoop::Kind::fixed_step)
            return std::nullopt;
        return ray;
    }

    static proof::Interval at(int pixel) { return {pixel + 0.5, pixel + 0.5}; }

    static double behind(const proof::MarchSlice& slice, const proof::March& march) {
        return slice.start() + k_behind * (slice.parameter(march.turns.back()) - slice.start());
    }

    static bool runs_out(const MarchRay& ray, const proof::MarchingLoop& loop) {
        const proof::March& march = ray.march;
        const bool beyond = march.far && march.turns.back().carried[0] > *march.far;
        return !march.hit && !beyond && march.turns.size() >= *loop.turns;
    }

    /// Returns whether the march took a sample below the surface, or moved to and fro around it.
    static bool was_past(const MarchRay& ray, const proof::MarchingLoop& loop) {
        if (loop.kind != proof::MarchingLoop::Kind::sphere_tracing)
            return false;
        size_t back = 0;
        const auto& turns = ray.march.turns;
        for (size_t i = 0; i < turns.size(); ++i) {
            if (turns[i].distance() < k_surely_past)
                return true;
            back += ray.slice && i > 0 && ray.slice->parameter(turns[i]) < ray.slice->parameter(turns[i - 1]);
        }
        return double(back) > k_to_and_fro * double(turns.size());
    }

    /// Counts a ray that runs out, by whether more iterations hit something that shows.
    void add_out(glm::ivec2 pixel, const MarchRay& ray, const proof::MarchingLoop& loop) {
        const bool past = was_past(ray, loop);
        const uint32_t most = k_longer_loop * *loop.turns;
        const LongerMarch longer = past ? LongerMarch{} : rays_.march_longer(pixel, most);
        longer_ += past ? 0 : most;
        if (!past && !(longer.hits && longer.shows)) {
            ++counts_.out_of_none;
            return;
        }
        counts_.past += past;
        if (counts_.out++ > 0)
            return;
        counts_.pixel = pixel;
        counts_.state = state_;
        counts_.line = loop.line;
        counts_.hands_on = loop.hands_on;
    }

    std::optional<uint32_t> bound(const RayArea& area, size_t loop, double end) {
        auto all = rays_.enter_all(area, proof::SliceOf::step, proof::Surface::threshold);
        ++used_;
        if (!all || all->loop != loop)
            return std::nullopt;
        const auto most = proof::most_turns(all->slice, all->slice.far().value_or(end),
                                            *rays_.function().loops()[loop].turns, k_most_of_a_bound);
        used_ += all->slice.evaluations();
        return most;
    }

    /// Returns for how many seconds of the span the bound holds, by bisection.
    double proved_of(glm::ivec2 pixel, const proof::Interval& span, size_t loop, double end) {
        if (bound({at(pixel.x), at(pixel.y), span}, loop, end))
            return span.width();
        if (span.width() <= k_shortest_span)
            return 0;
        const double middle = span.low + span.width() / 2;
        return proved_of(pixel, {span.low, middle}, loop, end) +
               proved_of(pixel, {middle, span.high}, loop, end);
    }

    const MarchRays& rays_;
    const FrameState& state_;
    TurnCounts& counts_;
    size_t number_ = 0;
    uint64_t used_ = 0;
    uint64_t longer_ = 0; ///< iterations of longer marches
};

std::string turns_sentence(const PassFunction& function, const TurnCounts& counts) {
    std::string text = fmt::format("{:.3g} % of {} rays run out of the loop's {} iterations before they hit",
                                   share(double(counts.out), double(counts.rays)), counts.rays, counts.turns);
    if (counts.out > 0) {
        const SourceLocation where = function.locate(counts.line);
        text += fmt::format(", as pixel {},{} at {:g} s: {}:{} tests the distance: take {} steps",
                            counts.pixel.x, counts.pixel.y, counts.state.seconds(), where.file, where.line,
                            2 * counts.past > counts.out ? "shorter" : "more");
    }
    if (counts.out_of_none > 0)
        text += fmt::format("; {:.3g} % run out where more iterations change nothing",
                            share(double(counts.out_of_none), double(counts.rays)));
    if (counts.needed > 0)
        text += fmt::format("; the others need at most {}", counts.needed);
    text += fmt::format("; {:.3g} % of {} rays are proved not to run out",
                        share(double(counts.proved), double(counts.looked_at)), counts.looked_at);
    if (counts.unfollowed > 0)
        text += fmt::format(" ({:.3g} % could not be followed)",
                            share(double(counts.unfollowed), double(counts.looked_at)));
    if (counts.proved > 0 && counts.rays_over_time > 0)
        text +=
            fmt::format(", of {} rays at {:.3g} % of all times from {:g} to {:g} s", counts.rays_over_time,
                        share(counts.proved_seconds, double(counts.rays_over_time) * k_span.width()),
                        k_span.low, k_span.high);
    return text;
}

} // namespace

Result<Answer> ask_turns(ProbeBench& bench) {
    const auto pass = TRY(marching_pass(bench));
    if (!pass)
        return without_march(bench);
    TurnCounts counts;
    for (const double moment : k_ray_moments) {
        const FrameState state = state_at(moment);
        const render::Renderer& renderer = *TRY(bench.drawn(state));
        const MarchRays rays({*pass->function, renderer, pass->index, render::inputs_of(state)});
        TurnLook look(rays, state, counts);
        look_at_rays(renderer.extent(), [&](glm::ivec2 pixel) {
            look.follow(pixel);
            return 0;
        });
        look_at_rays(renderer.extent(), [&](glm::ivec2 pixel) { return look.bound(pixel); });
    }
    if (counts.rays == 0)
        return Answer{Verdict::not_applicable,
                      "no ray reaches a loop that steps by a distance and has a fixed number of iterations"};
    if (counts.contradicted > 0)
        return Answer{
            Verdict::not_applicable,
            fmt::format("{} rays contradict their proof: please report this scene", counts.contradicted)};
    Answer answer{Verdict::pass, turns_sentence(*pass->function, counts)};
    if (share(double(counts.out), double(counts.rays)) >
        most_allowed(bench, bench.promises().most_exhausted_percent, "most_exhausted_percent")) {
        answer.verdict = counts.hands_on ? Verdict::note : Verdict::warn;
        add_place(answer, pass->function->locate(counts.line));
        answer.where = counts.state;
        answer.effect = "rays run out of iterations before they hit anything";
        answer.cause = 2 * counts.past > counts.out
                           ? "steps past the surface are too long: take shorter ones"
                           : fmt::format("the loop ends after {} iterations; with up to {} they hit",
                                         counts.turns, k_longer_loop * counts.turns);
        bench.report_running_out("turns");
    }
    return answer;
}

} // namespace tidemark::lab
