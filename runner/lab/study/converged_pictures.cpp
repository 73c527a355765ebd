#include "lab/stopwatch.hpp"
#include "lab/study/stricter.hpp"
#include "lab/study/truth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace tidemark::lab {
namespace {

constexpr int k_most_steps = 6;
/// A reference is good enough when the next stricter one differs by this part of what the strictest point
/// does.
constexpr double k_settled = 0.1;

/// A step that takes longer, seconds, is the last: the next one would take twice as long, doubles several
/// times.
constexpr double k_longest_step = 20;

/// What one setting of the scene shows in all views.
struct Shown {
    std::vector<Setting> settings;
    std::vector<image::Image> pictures;
    std::vector<Hits> hits;
    std::string precision = "in single precision";
    double seconds = 0; ///< that it took
};

Result<std::optional<Shown>> show(const scene::Scene& scene, const Study& study, const Recipe& recipe,
                                  const KeepGoing& keep_going) {
    const Stopwatch watch;
    auto specimen = Specimen::create(scene, recipe, study.extent);
    if (!specimen)
        return fail(std::move(specimen.error()));
    Shown shown{recipe.settings, {}, {}};
    for (const View& view : study.views) {
        if (!keep_going())
            return std::optional<Shown>{};
        shown.pictures.push_back(specimen->picture(view));
        if (!specimen->has_hits())
            continue;
        auto hits = specimen->hits(view);
        if (!hits)
            return fail(std::move(hits.error()));
        shown.hits.push_back(*std::move(hits));
    }
    shown.seconds = watch.elapsed().wall * 1e-3;
    if (recipe.precision != glsl::Precision::single) {
        const auto kept = specimen->kept_hashes();
        shown.precision =
            "promoted to double" +
            (kept.empty() ? "" : fmt::format(" (hashes kept in floats: {})", fmt::join(kept, ", ")));
    }
    return std::optional<Shown>(std::move(shown));
}

double rms_of_hits(const std::vector<Hits>& left, const std::vector<Hits>& right, Extent extent) {
    Hits all_left, all_right;
    for (size_t i = 0; i < left.size(); ++i) {
        all_left.append(left[i]);
        all_right.append(right[i]);
    }
    std::vector<double> footprint;
    for (size_t i = 0; i < left.size(); ++i) {
        const auto plain = plain_footprint(extent);
        footprint.insert(footprint.end(), plain.begin(), plain.end());
    }
    return hit_errors(all_left, all_right, footprint).rms;
}

/// A change of two references and how it was come by.
struct Change {
    double pictures = 0;
    double hits = 0;
};

Change change_of(const Shown& a, const Shown& b, Extent extent) {
    return {pooled_rmse(a.pictures, b.pictures), a.hits.empty() ? 0 : rms_of_hits(a.hits, b.hits, extent)};
}

PictureTruth truth_of(Shown shown, const std::optional<Change>& change, const std::string& how) {
    PictureTruth truth;
    truth.standard.method =
        fmt::format("the scene itself with {}, {}", to_string(shown.settings), shown.precision);
    truth.standard.check = how;
    if (change)
        truth.standard.uncertainty = change->pictures;
    if (!shown.hits.empty()) {
        truth.hit_standard = truth.standard;
        if (change)
            truth.hit_standard.uncertainty = change->hits;
    }
    truth.settings = std::move(shown.settings);
    truth.views = std::move(shown.pictures);
    truth.hits = std::move(shown.hits);
    return truth;
}

} // namespace

std::vector<double> plain_footprint(Extent extent) {
    return std::vector<double>(extent.pixels(), 1.0 / extent.height);
}

double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right) {
    double squares = 0;
    size_t samples = 0;
    for (size_t i = 0; i < left.size(); ++i) {
        const auto difference = image::compare(left[i], right[i]);
        squares += difference ? difference->rmse * difference->rmse * double(left[i].samples()) : NAN;
        samples += left[i].samples();
    }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

Result<PictureTruth> converged_pictures(const scene::Scene& scene, const Study& study,
                                        const KeepGoing& keep_going) {
    auto first = show(scene, study, {strictest(study, 0), study.precision}, keep_going);
    if (!first)
        return fail(std::move(first.error()));
    if (!*first)
        return fail(ErrorCode::check_failed, "interrupted before there was a reference");
    Shown best = **first;
    const Shown& strictest_point = **first;
    std::optional<Change> change;
    std::string how =
        "none: no knob of the study is a number that could go on; name a stricter setting with --reference";
    for (int step = 1; step <= k_most_steps; ++step) {
        std::vector<Setting> settings = strictest(study, step);
        if (settings == best.settings)
            break;
        auto next = show(scene, study, {settings, study.precision}, keep_going);
        if (!next || !*next) {
            if (change)
                break;
            how = next ? "none: interrupted"
                       : fmt::format("none: the scene does not compile with {}", to_string(settings));
            break;
        }
        const Change changed = change_of(best, **next, study.extent);
        const bool grew = change && changed.pictures > change->pictures;
        if (grew) // past the best that floats can do: the pair before was nearer
            break;
        how = fmt::format("the change from {}: RMSE {:.2g}", to_string(best.settings), changed.pictures);
        change = changed;
        const bool named = !study.reference.empty();
        if (named) { // it stays the reference that was asked for
            how = fmt::format("the change to {}: RMSE {:.2g}", to_string(settings), changed.pictures);
            break;
        }
        best = **std::move(next);
        if (changed.pictures <= k_settled * pooled_rmse(strictest_point.pictures, best.pictures) ||
            best.seconds > k_longest_step)
            break;
    }
    // What is in double already, like the points, is stricter by its settings alone.
    const bool to_promote = study.precision == glsl::Precision::single;
    std::string not_promoted;
    if (to_promote && best.seconds > k_longest_step)
        not_promoted = fmt::format("it took {:.0f} s in floats already", best.seconds);
    if (to_promote && not_promoted.empty()) {
        auto promoted = show(scene, study, {best.settings, glsl::Precision::promoted}, keep_going);
        not_promoted = !promoted ? to_string(promoted.error()) : !*promoted ? "interrupted" : "";
        if (promoted && *promoted)
            best = **std::move(promoted);
    }
    PictureTruth truth = truth_of(std::move(best), change, how);
    truth.precision = !to_promote            ? study.precision
                      : not_promoted.empty() ? glsl::Precision::promoted
                                             : glsl::Precision::single;
    truth.not_promoted = std::move(not_promoted);
    return truth;
}

} // namespace tidemark::lab
