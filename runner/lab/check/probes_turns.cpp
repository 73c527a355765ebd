// Checks whether rays run out of their march's iterations: in float, and by proved bounds from the least
// length of each step.
#include "base/try.hpp"
#include "ir/turn_bound.hpp"
#include "lab/check/marching_pass.hpp"
#include "lab/check/probes.hpp"
#include "lab/march/march_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// Most evaluations for the bound of one ray, or of one ray over a span of time.
constexpr uint64_t k_most_of_a_bound = 500;
/// The checked span in seconds, and the shortest part that it is divided into.
constexpr ir::Interval k_span{0, 10};
constexpr double k_shortest_span = 10.0 / 16;
/// One in so many rays is checked over the span.
constexpr size_t k_every = 4;
/// A march without a limit is ended by a wall; it is looked for up to this multiple of the way to the last
/// iteration.
constexpr double k_behind = 2;

struct TurnCounts {
    size_t rays = 0, out = 0;
    size_t looked_at = 0, proved = 0, contradicted = 0; ///< of the rays to bound
    size_t unfollowed = 0; ///< their step is not one value that each iteration adds
    size_t needed = 0;                                  ///< most iterations of a march that does not run out
    uint32_t turns = 0;
    size_t rays_over_time = 0;
    double proved_seconds = 0; ///< sum over those rays
    glm::ivec2 pixel{0};       ///< of the first ray that runs out
    FrameState state{};
    int line = 0;
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
        const auto ray = enter(pixel);
        if (!ray)
            return;
        const ir::MarchingLoop& loop = loop_of(*ray);
        ++counts_.rays;
        counts_.turns = std::max(counts_.turns, *loop.turns);
        if (runs_out(*ray, loop))
            remember(pixel, loop);
        else
            counts_.needed = std::max(counts_.needed, ray->march.turns.size());
    }

    /// Bounds the iterations of a ray and counts the result; returns the evaluations it took.
    uint64_t bound(glm::ivec2 pixel) {
        const auto ray = enter(pixel);
        if (!ray)
            return 0;
        const ir::MarchingLoop& loop = loop_of(*ray);
        const bool out = runs_out(*ray, loop);
        ++counts_.looked_at;
        counts_.unfollowed += !out && (!ray->slice || loop.advance == ir::k_no_value);
        if (!ray->slice)
            return 1;
        used_ = 0;
        const ir::March& march = ray->march;
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
    const ir::MarchingLoop& loop_of(const MarchRay& ray) const { return rays_.function().loops()[ray.loop]; }

    /// Returns the ray if its loop steps by a distance and counts its iterations.
    std::optional<MarchRay> enter(glm::ivec2 pixel) const {
        auto ray = rays_.enter(pixel, ir::Surface::threshold);
        if (!ray || ray->march.turns.empty() || !loop_of(*ray).turns ||
            loop_of(*ray).kind == ir::MarchingLoop::Kind::fixed_step)
            return std::nullopt;
        return ray;
    }

    static ir::Interval at(int pixel) { return {pixel + 0.5, pixel + 0.5}; }

    static double behind(const ir::MarchSlice& slice, const ir::March& march) {
        return slice.start() + k_behind * (slice.parameter(march.turns.back()) - slice.start());
    }

    static bool runs_out(const MarchRay& ray, const ir::MarchingLoop& loop) {
        const ir::March& march = ray.march;
        const bool beyond = march.far && march.turns.back().carried[0] > *march.far;
        return !march.hit && !beyond && march.turns.size() >= *loop.turns;
    }

    void remember(glm::ivec2 pixel, const ir::MarchingLoop& loop) {
        if (counts_.out++ > 0)
            return;
        counts_.pixel = pixel;
        counts_.state = state_;
        counts_.line = loop.line;
    }

    std::optional<uint32_t> bound(const RayArea& area, size_t loop, double end) {
        auto all = rays_.enter_all(area, ir::SliceOf::step, ir::Surface::threshold);
        ++used_;
        if (!all || all->loop != loop)
            return std::nullopt;
        const auto most = ir::most_turns(all->slice, all->slice.far().value_or(end),
                                         *rays_.function().loops()[loop].turns, k_most_of_a_bound);
        used_ += all->slice.evaluations();
        return most;
    }

    /// Returns for how many seconds of the span the bound holds, by bisection.
    double proved_of(glm::ivec2 pixel, const ir::Interval& span, size_t loop, double end) {
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
};

std::string turns_sentence(const PassFunction& function, const TurnCounts& counts) {
    std::string text = fmt::format("{:.3g} % of {} rays run out of the loop's {} turns",
                                   share(double(counts.out), double(counts.rays)), counts.rays, counts.turns);
    if (counts.out > 0) {
        const SourceLocation where = function.locate(counts.line);
        text += fmt::format(", as pixel {},{} at {:g} s: {}:{} tests the distance", counts.pixel.x,
                            counts.pixel.y, counts.state.seconds(), where.file, where.line);
    }
    text += fmt::format("; the others need {} at most; of {} rays {:.3g} % are proved not to", counts.needed,
                        counts.looked_at, share(double(counts.proved), double(counts.looked_at)));
    if (counts.unfollowed > 0)
        text += fmt::format(" (what {:.3g} % add to their way is not followed)",
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
                      "no ray comes to a loop that steps by a distance, and counts its turns up to a number"};
    if (counts.contradicted > 0)
        return Answer{
            Verdict::not_applicable,
            fmt::format("{} rays contradict their proof: please report this scene", counts.contradicted)};
    Answer answer{Verdict::pass, turns_sentence(*pass->function, counts)};
    if (share(double(counts.out), double(counts.rays)) > bench.promises().most_exhausted_percent) {
        answer.verdict = Verdict::warn;
        answer.sentence += "; take more steps, or longer ones";
        answer.where = counts.state;
    }
    return answer;
}

} // namespace tidemark::lab
