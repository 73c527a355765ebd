#include "lab/march/true_hits.hpp"

#include "ir/first_hit.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/on_all_cores.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace tidemark::lab {
namespace {

constexpr double k_relative_width = 1e-9;
constexpr uint64_t k_most_evaluations = 20'000;
/// Rays that tell how long one takes.
constexpr size_t k_pilot = 64;
/// Beyond a hit of the march's own, where it has no limit.
constexpr double k_beyond = 1.5;

/// The rays of one picture.
class Rays {
public:
    explicit Rays(const DrawnPass& drawn)
        : drawn_(drawn), textures_(textures_of(drawn.renderer, drawn.pass)),
          floats_(drawn.function.frame<float>(drawn.renderer, drawn.pass, drawn.inputs)),
          doubles_(drawn.function.frame<double>(drawn.renderer, drawn.pass, drawn.inputs)) {
        floats_.textures = looked_up<ir::Point<float>>();
        doubles_.textures = looked_up<ir::Point<double>>();
    }

    Extent extent() const { return drawn_.renderer.extent(); }

    /// The interval of the first hit; of a ray that has none {-1, -1}; nothing where it is not known.
    std::optional<ir::Interval> hit(glm::ivec2 pixel) const {
        const PassFunction& function = drawn_.function;
        ir::FloatEvaluator in_float = floats_;
        ir::PointEvaluator<double> in_double = doubles_;
        function.move_to(in_float, pixel);
        function.move_to(in_double, pixel);
        const auto index = ir::enter_first(in_float, function.loops());
        if (index != ir::enter_first(in_double, function.loops()))
            return std::nullopt;
        if (!index)
            return k_miss;
        const ir::MarchingLoop& loop = function.loops()[*index];
        const ir::FloatEvaluator entered = in_float;
        const ir::March march = ir::follow(in_float, function.function(), loop);
        if (march.turns.empty())
            return k_miss;
        if (!ir::is_faithful(loop, entered, march))
            return std::nullopt;
        ir::MarchSlice slice(function.function(), loop, in_double, looked_up<ir::Interval>(),
                             ir::Surface::zero);
        return first_hit_of(slice, loop, march);
    }

private:
    static constexpr ir::Interval k_miss{-1, -1};

    template <class Number>
    ir::Textures<Number> looked_up() const {
        return [this](const ir::Lookup& lookup, std::span<const Number> operands) {
            return ir::look_up(textures_, lookup, operands);
        };
    }

    static std::optional<ir::Interval> first_hit_of(ir::MarchSlice& slice, const ir::MarchingLoop& loop,
                                                    const ir::March& march) {
        const bool limited = loop.far != ir::k_no_value && loop.by_parameter();
        const double way = slice.parameter(march.turns.back()) - slice.start();
        const double last = limited ? march.far : slice.start() + (march.hit ? k_beyond : 1) * way;
        if (!std::isfinite(last) || last <= slice.start())
            return limited ? std::optional(k_miss) : std::nullopt;
        const ir::FirstHit found = ir::first_hit(slice, last, k_most_evaluations, k_relative_width);
        if (found.verdict == ir::FirstHit::Verdict::hit)
            return ir::Interval{found.where.low, found.where.high};
        const bool none = found.verdict == ir::FirstHit::Verdict::none && limited;
        return none ? std::optional(k_miss) : std::nullopt;
    }

    const DrawnPass& drawn_;
    ir::TextureSet textures_;
    ir::FloatEvaluator floats_;
    ir::PointEvaluator<double> doubles_;
};

double seconds_of(const Rays& rays, size_t pixels) {
    const auto start = std::chrono::steady_clock::now();
    for (size_t i = 0; i < k_pilot; ++i) {
        const auto at = int(spread(i, pixels));
        (void)rays.hit({at % rays.extent().width, at / rays.extent().width});
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / k_pilot;
}

} // namespace

std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going) {
    const Rays rays(drawn);
    const Extent extent = rays.extent();
    const size_t pixels = extent.pixels();
    const double affordable =
        seconds * std::max(1u, std::thread::hardware_concurrency()) / seconds_of(rays, pixels);
    TrueHits truth;
    truth.every = size_t(std::ceil(std::max(1.0, double(pixels) / affordable)));
    truth.looked_at = pixels / truth.every;
    truth.hits.distance.assign(pixels, std::nan(""));
    truth.hits.evaluations.assign(pixels, 0.0f);
    truth.hits.flags.assign(pixels, 0);
    std::vector<std::optional<ir::Interval>> found(truth.looked_at);
    const bool complete = on_all_cores(truth.looked_at, keep_going, [&](size_t i) {
        const auto at = int(spread(i, pixels));
        found[i] = rays.hit({at % extent.width, at / extent.width});
    });
    if (!complete)
        return std::nullopt;
    double squares = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (!found[i]) {
            ++truth.unknown;
            continue;
        }
        truth.hits.distance[spread(i, pixels)] = found[i]->low + found[i]->width() / 2;
        squares += found[i]->width() * found[i]->width() / 4;
    }
    truth.half_width = std::sqrt(squares / double(std::max<size_t>(1, truth.looked_at - truth.unknown)));
    return truth;
}

} // namespace tidemark::lab
