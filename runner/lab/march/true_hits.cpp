#include "lab/march/true_hits.hpp"

#include "ir/first_hit.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/on_all_cores.hpp"
#include "lab/spread.hpp"

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

/// The rays of one picture.
class Rays {
public:
    explicit Rays(const DrawnPass& drawn)
        : drawn_(drawn), textures_(textures_of(drawn.renderer, drawn.pass)),
          floats_(drawn.function.frame<float>(drawn.renderer, drawn.pass, drawn.inputs)),
          doubles_(drawn.function.frame<double>(drawn.renderer, drawn.pass, drawn.inputs)) {
        floats_.textures = ir::textures_in<ir::Point<float>>(textures_);
        doubles_.textures = ir::textures_in<ir::Point<double>>(textures_);
    }

    Extent extent() const { return drawn_.renderer.extent(); }

    /// The interval of the first hit; of a ray that has none {-1, -1}; nothing where it is not known.
    std::optional<ir::Interval> hit(size_t number) const {
        const glm::ivec2 pixel{int(number) % extent().width, int(number) / extent().width};
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
        ir::MarchSlice slice(function.function(), loop, in_double, ir::textures_in<ir::Interval>(textures_),
                             ir::Surface::zero);
        return first_hit_of(slice, loop, march);
    }

private:
    static constexpr ir::Interval k_miss{-1, -1};

    static std::optional<ir::Interval> first_hit_of(ir::MarchSlice& slice, const ir::MarchingLoop& loop,
                                                    const ir::March& march) {
        const bool limited = loop.limited();
        const double last = slice.end(march);
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

using Found = std::vector<std::optional<ir::Interval>>;

/// The first few rays, and how many seconds one takes.
double pilot(const Rays& rays, Found& found) {
    const size_t pixels = rays.extent().pixels();
    const auto start = std::chrono::steady_clock::now();
    while (found.size() < std::min(k_pilot, pixels))
        found.push_back(rays.hit(spread(found.size(), pixels)));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
           double(found.size());
}

TrueHits truth_of(const Found& found, size_t pixels) {
    TrueHits truth;
    truth.looked_at = found.size();
    truth.hits.distance.assign(pixels, std::nan(""));
    truth.hits.evaluations.assign(pixels, 0.0f);
    truth.hits.flags.assign(pixels, 0);
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

} // namespace

std::optional<TrueHits> true_hits(const DrawnPass& drawn, double seconds, const KeepGoing& keep_going) {
    const Rays rays(drawn);
    const size_t pixels = rays.extent().pixels();
    Found found;
    const double one = pilot(rays, found);
    const double affordable = seconds * std::max(1u, std::thread::hardware_concurrency()) / one;
    const auto every = size_t(std::ceil(std::max(1.0, double(pixels) / affordable)));
    const size_t first = found.size();
    found.resize(std::max(first, pixels / every));
    const bool complete = on_all_cores(found.size() - first, keep_going, [&](size_t i) {
        found[first + i] = rays.hit(spread(first + i, pixels));
    });
    return complete ? std::optional(truth_of(found, pixels)) : std::nullopt;
}

} // namespace tidemark::lab
