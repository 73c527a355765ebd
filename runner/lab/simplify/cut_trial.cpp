#include "lab/simplify/cut_trial.hpp"

#include "base/try.hpp"
#include "lab/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

constexpr size_t k_fewest_trials = 3, k_most_trials = 25;
constexpr double k_enough_milliseconds = 120; ///< of rounds
/// A picture has so many parts, in each of which the RMSE is at most so many times what is allowed.
constexpr int k_part_columns = 16, k_part_rows = 9;
constexpr double k_most_in_a_part = 3;

std::vector<image::Image> pictures_of(Specimen& specimen, const std::vector<View>& views) {
    std::vector<image::Image> pictures;
    for (const View& view : views)
        pictures.push_back(specimen.picture(view));
    return pictures;
}

/// Pixels that are no numbers have no truth.
Result<Truth> truth_of(std::vector<image::Image> pictures) {
    Truth truth{std::move(pictures), {}, {}, {}};
    size_t blind = 0, pixels = 0;
    for (const image::Image& picture : truth.pictures) {
        PixelMask& mask = truth.blind.emplace_back(picture.extent.pixels(), false);
        const auto channels = size_t(picture.channels);
        for (size_t i = 0; i < picture.samples(); ++i)
            if (!std::isfinite(picture.f32()[i]))
                mask[i / channels] = true;
        blind += size_t(std::ranges::count(mask, true));
        pixels += mask.size();
    }
    if (double(blind) > k_most_blind * double(pixels))
        return fail(ErrorCode::check_failed,
                    fmt::format("cannot say: {:.3g} % of the picture's pixels are NaN or infinite",
                                100.0 * double(blind) / double(pixels)));
    return truth;
}

/// A small difference that a measure rounds to nothing is one, too.
double error_of(Measure measure, const Outcome& outcome) {
    if (outcome.picture.samples.equal())
        return 0;
    return std::max(error_by(measure, outcome), std::numeric_limits<double>::min());
}

/// By the clock that counts the work: the CPU's where the CPU draws.
double clocked(const Elapsed& elapsed, bool by_cpu) {
    return by_cpu ? elapsed.cpu : elapsed.wall;
}

/// The points of a study of whole scenes, to be drawn, held against the first, and timed.
class SceneComparison {
public:
    SceneComparison(const Study& study, const Circumstances& circumstances) {
        findings_.set.study = study;
        findings_.set.study.series = {{"cut", Trust::unknown, {}, {}}};
        findings_.set.circumstances = circumstances;
        findings_.set.words.defaults = "the scene as it is";
        findings_.set.picture_standard = {"the scene as it is", 0.0,
                                          "none of its own: what is asked is how far a cut scene is from it"};
    }

    void add(const std::string& label, const scene::Scene& scene, bool own) {
        WorkPrecision& point = findings_.set.points.emplace_back();
        point.point = {own ? size_t(1) : size_t(0), label, label, {}};
        auto specimen = Specimen::create(scene, {}, study().extent);
        if (!specimen)
            point.failure = to_string(specimen.error());
        auto& pictures = findings_.evidence.pictures.emplace_back();
        if (specimen) {
            pictures = pictures_of(*specimen, study().views);
            point.compile_milliseconds = specimen->compile_milliseconds();
            point.first_draw_milliseconds = specimen->first_draw_milliseconds();
        }
        specimens_.push_back(specimen ? std::optional(*std::move(specimen)) : std::nullopt);
    }

    Result<Findings> run(const Timing& timing, const Watch& watch) {
        auto& points = findings_.set.points;
        if (!points.front().failure.empty())
            return fail(ErrorCode::load, points.front().failure);
        const Truth truth = TRY(truth_of(findings_.evidence.pictures.front()));
        for (size_t i = 0; i < points.size(); ++i) {
            if (!points[i].failure.empty())
                continue;
            const Sight sight{findings_.evidence.pictures[i], {}};
            for (size_t view = 0; view < study().views.size(); ++view)
                points[i].views.push_back(outcome_of(sight, truth, view));
            points[i].all = outcome_of_all(sight, truth, points[i].views);
        }
        findings_.set.circumstances.complete = time_points(
            timing, watch,
            [this](size_t point, size_t view, bool ask_gpu) {
                return specimens_[point]->time(study().views[view], ask_gpu);
            },
            findings_.set);
        judge(findings_.set);
        findings_.evidence.reference = truth.pictures;
        findings_.evidence.causes.resize(points.size());
        return std::move(findings_);
    }

private:
    const Study& study() const { return findings_.set.study; }

    Findings findings_{};
    std::vector<std::optional<Specimen>> specimens_{};
};

/// RMSE of what a screen shows of a part; what is no number in the own picture does not count.
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
    bench.truth_ = TRY(truth_of(pictures_of(bench.own_, bench.views_)));
    return bench;
}

std::optional<CutTrial> CutBench::try_cuts(std::span<const glsl::Cure> cuts, Specimen& other,
                                           const Goal& goal) {
    const auto scene = changed(*scene_, cuts);
    auto specimen = scene ? Specimen::create(*scene, {}, extent_) : fail(ErrorCode::load, "");
    if (!specimen)
        return std::nullopt;
    CutTrial trial{*std::move(specimen)};
    const Sight sight{pictures_of(trial.specimen, views_), {}};
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

/// The median of what it takes, of rounds in which both are drawn in turns.
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

Result<Findings> compare_scenes(const scene::Scene& scene,
                                const std::vector<std::pair<std::string, scene::Scene>>& others,
                                const Study& study, const Timing& timing, const Watch& watch,
                                const Circumstances& circumstances) {
    SceneComparison comparison(study, circumstances);
    comparison.add(std::string(k_defaults), scene, true);
    for (const auto& [label, other] : others)
        comparison.add(label, other, false);
    return comparison.run(timing, watch);
}

} // namespace tidemark::lab
