#include "lab/simplify/cut_trial.hpp"

#include "base/try.hpp"
#include "lab/changed_scene.hpp"
#include "lab/study/scene_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

constexpr size_t k_fewest_trials = 3, k_most_trials = 25;
constexpr double k_enough_milliseconds = 120; ///< for the timing rounds
/// A picture is divided into this many parts; the RMSE of each may be this many times the allowed error.
constexpr int k_part_columns = 16, k_part_rows = 9;
constexpr double k_most_in_a_part = 3;

/// Small differences that the measure rounds to zero count as more than zero.
double error_of(Measure measure, const Outcome& outcome) {
    if (outcome.picture.samples.equal())
        return 0;
    return std::max(error_by(measure, outcome), std::numeric_limits<double>::min());
}

/// Returns the CPU time if the CPU draws, else the wall time.
double clocked(const Elapsed& elapsed, bool by_cpu) {
    return by_cpu ? elapsed.cpu : elapsed.wall;
}

/// Returns the RMSE of a part as displayed; pixels that are NaN or infinite in the own picture do not count.
double rmse_of_part(const image::Image& own, const image::Image& cut, int part) {
    const auto [width, height] = own.extent;
    const int column = part % k_part_columns, row = part / k_part_columns;
    const auto channels = size_t(own.channels);
    double squares = 0;
    size_t samples = 0;
    for (int y = height * row / k_part_rows; y < height * (row + 1) / k_part_rows; ++y)
        for (int x = width * column / k_part_columns; x < width * (column + 1) / k_part_columns; ++x)
            for (size_t k = 0; k < channels; ++k) {
                const size_t i = (size_t(y) * size_t(width) + size_t(x)) * channels + k;
                if (!std::isfinite(own.f32()[i]))
                    continue;
                const double gap =
                    std::clamp(double(cut.f32()[i]), 0.0, 1.0) - std::clamp(double(own.f32()[i]), 0.0, 1.0);
                squares += gap * gap;
                ++samples;
            }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

} // namespace

bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut) {
    for (int part = 0; part < k_part_columns * k_part_rows; ++part)
        if (rmse_of_part(own, cut, part) > k_most_in_a_part * *goal.most_error)
            return false;
    return true;
}

Result<CutBench> CutBench::create(const scene::Scene& scene, Extent extent, std::vector<View> views) {
    auto own = TRY(Specimen::create(scene, {}, extent));
    CutBench bench(scene, extent, std::move(views), std::move(own));
    bench.truth_ = TRY(truth_of(bench.own_.pictures(bench.views_)));
    return bench;
}

std::optional<CutTrial> CutBench::try_cuts(std::span<const glsl::Cure> cuts, Specimen& other,
                                           const Goal& goal) {
    const auto scene = changed(*scene_, cuts);
    auto specimen = scene ? Specimen::create(*scene, {}, extent_) : fail(ErrorCode::load, "");
    if (!specimen)
        return std::nullopt;
    CutTrial trial{*std::move(specimen)};
    const Sight sight{trial.specimen.pictures(views_), {}};
    for (size_t view = 0; view < views_.size(); ++view) {
        const double error = error_of(goal.measure, outcome_of(sight, truth_, view));
        if (!(error <= *goal.most_error) || !keeps_parts(goal, truth_.pictures[view], sight.pictures[view]))
            return std::nullopt;
        trial.error = std::max(trial.error, error);
    }
    trial.time = relative_time(trial.specimen, other);
    return trial;
}

double CutBench::milliseconds() {
    std::vector<double> rounds;
    for (size_t round = 0; round < k_fewest_trials; ++round) {
        double sum = 0;
        for (const View& view : views_)
            sum += own_.time(view, false).elapsed.wall;
        rounds.push_back(sum / double(views_.size()));
    }
    return median(rounds);
}

double CutBench::seconds_of_trial() {
    const auto drawn = double(views_.size() * (1 + 2 * k_fewest_trials));
    return milliseconds() * 1e-3 * drawn;
}

/// Returns the median ratio of the times, over rounds that draw both alternately.
double CutBench::relative_time(Specimen& one, Specimen& other) const {
    std::vector<Elapsed> ones, others;
    const Stopwatch clock;
    for (size_t round = 0; round < k_most_trials; ++round) {
        if (round >= k_fewest_trials && clock.elapsed().wall > k_enough_milliseconds)
            break;
        Elapsed sums[2]{};
        for (const View& view : views_)
            for (Specimen* const each : {&one, &other}) {
                const Elapsed elapsed = each->time(view, false).elapsed;
                sums[each == &other].wall += elapsed.wall;
                sums[each == &other].cpu += elapsed.cpu;
            }
        ones.push_back(sums[0]);
        others.push_back(sums[1]);
    }
    double wall = 0, cpu = 0;
    for (const Elapsed& elapsed : others) {
        wall += elapsed.wall;
        cpu += elapsed.cpu;
    }
    const bool by_cpu = cpu > 0.5 * wall;
    std::vector<double> ratios;
    for (size_t i = 0; i < ones.size(); ++i)
        ratios.push_back(clocked(ones[i], by_cpu) / clocked(others[i], by_cpu));
    return median(ratios);
}

} // namespace tidemark::lab
