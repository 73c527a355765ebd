#include "lab/truth.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "base/tokens.hpp"
#include "lab/specimen.hpp"
#include "lab/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tidemark::lab {
namespace {

/// Returns 1 / (1 - r): the sum of all changes from this one on, divided by this one.
double sum_over_last(double before, double last) {
    return 1 / (1 - last / before);
}

} // namespace

Remainder remainder_of(const std::vector<double>& changes, double rounding) {
    if (changes.empty())
        return {{}, "no knob of the study is a number that can be made stricter", false};
    const double last = changes.back();
    if (std::isnan(last))
        return {{}, "the change of the last step is NaN", false};
    if (last <= rounding)
        return {rounding, fmt::format("the last step changed {:.2g}, which is rounding", last), true};
    if (changes.size() < 2)
        return {{}, fmt::format("one change, {:.2g}, is too few to estimate the rest", last), false};
    const double before = changes[changes.size() - 2];
    const double ratio = last / before;
    if (!(ratio < 1))
        return {
            {},
            fmt::format("it does not converge: the last two steps changed {:.2g} and {:.2g}", before, last),
            false};
    const double sum = sum_over_last(before, last);
    const double first = changes.size() > 2 ? changes[changes.size() - 3] : 0;
    // These sums grow by this amount from step to step: 0 for a power of the setting, 1/s for its logarithm
    // to the power of -s.
    const double growth = before < first ? std::max(0.0, sum - sum_over_last(first, before)) : 0.0;
    if (!(growth < 0.9))
        return {{},
                fmt::format(
                    "it does not converge: the changes shrink more and more slowly ({:.2g}, {:.2g}, {:.2g})",
                    first, before, last),
                false};
    const double factor = sum / (1 - growth) - 1;
    return {
        std::max(rounding, last * factor),
        fmt::format("the last change was {:.2g}, {:.2g} of the one before; all further ones add up to {:.2g}",
                    last, ratio, last * factor),
        false};
}

void add_blind(const image::Image& picture, PixelMask& blind) {
    blind.resize(picture.extent.pixels(), false);
    const auto samples = picture.f32();
    const auto channels = size_t(picture.channels);
    for (size_t i = 0; i < samples.size(); ++i)
        if (!std::isfinite(samples[i]))
            blind[i / channels] = true;
}

std::string too_blind(size_t blind, size_t pixels) {
    if (double(blind) <= k_most_blind * double(pixels))
        return {};
    return fmt::format("{:.3g} % of its pixels are NaN or infinite", 100.0 * double(blind) / double(pixels));
}

std::vector<double> plain_footprint(Extent extent) {
    return std::vector<double>(extent.pixels(), 1.0 / extent.height);
}

double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right,
                   const std::vector<PixelMask>& blind) {
    double squares = 0;
    size_t samples = 0;
    for (size_t i = 0; i < left.size(); ++i) {
        const auto a = left[i].f32(), b = right[i].f32();
        const auto channels = size_t(left[i].channels);
        for (size_t k = 0; k < a.size(); ++k) {
            if (i < blind.size() && !blind[i].empty() && blind[i][k / channels])
                continue;
            const double change = double(a[k]) - double(b[k]); // NaN stays NaN
            squares += change * change;
            ++samples;
        }
    }
    return std::sqrt(squares / double(std::max<size_t>(1, samples)));
}

namespace {

constexpr int k_most_refinements = 6;
/// With three changes, a ratio that rises can be detected.
constexpr size_t k_wanted_changes = 3;
/// A reference is good enough if its own error is this share of the strictest point's.
constexpr double k_settled = 0.1;
/// How much longer than the study's limit a step may take while fewer than two changes are known.
constexpr double k_first_steps = 3;
/// Noise of float arithmetic at the end of a long sum, and of rounding a double to a float, in half units in
/// the last place.
constexpr double k_float_noise = 64, k_double_noise = 2;

/// The pictures and hits of one setting of the scene in all views.
struct Shown {
    std::vector<Setting> settings;
    std::vector<image::Image> pictures;
    std::vector<Hits> hits;
    std::vector<std::string> kept_hashes;
    double seconds = 0;    ///< time it took
    std::string cut{};     ///< the loops that the driver ended; empty: none
    bool buffered = false; ///< it was drawn from buffers of floats
};

std::vector<double> plain_footprints(size_t views, Extent extent) {
    return std::vector<double>(views * extent.pixels(), 1.0 / extent.height);
}

double rms_of_hits(const std::vector<Hits>& left, const std::vector<Hits>& right, Extent extent) {
    return hit_errors(joined(left), joined(right), plain_footprints(left.size(), extent)).rms;
}

double noise_of(const std::vector<image::Image>& pictures, const std::vector<PixelMask>& blind) {
    std::vector<image::Image> black;
    for (const image::Image& picture : pictures)
        black.emplace_back(picture.extent, picture.channels, picture.type);
    return 0x1p-24 * pooled_rmse(pictures, black, blind);
}

double noise_of(const std::vector<Hits>& hits) {
    double squares = 0;
    size_t count = 0;
    for (const Hits& view : hits)
        for (const double distance : view.distance)
            if (distance >= 0) {
                squares += distance * distance;
                ++count;
            }
    return 0x1p-24 * std::sqrt(squares / double(std::max<size_t>(1, count)));
}

/// Draws the scene at ever stricter settings, and estimates the error of the last one.
class Ladder {
public:
    Ladder(const scene::Scene& scene, const Study& study, const KeepGoing& keep_going)
        : scene_(scene), study_(study), keep_going_(keep_going), precision_(study.precision),
          specimen_(scene, study.extent, study.rays ? HitSource::main_hit : HitSource::none) {}

    Result<PictureTruth> climb() {
        if (study_.as_it_is)
            return unchanged();
        TRY(begin());
        while (step_up())
            ;
        return truth();
    }

private:
    enum class What { pictures, hits };

    double longest_first_step() const { return k_first_steps * study_.longest_step; }
    bool named() const { return !study_.reference.empty(); }
    bool has_hits() const { return !first_.hits.empty(); }

    Result<std::optional<Shown>> show(std::vector<Setting> settings) {
        const Stopwatch watch;
        Specimen* const specimen = TRY(specimen_.at(settings, precision_));
        Shown shown{std::move(settings), {}, {}, specimen->kept_hashes()};
        shown.buffered = specimen->has_buffers();
        if (!keep_going_())
            return std::optional<Shown>{};
        shown.pictures = specimen->pictures(study_.views);
        for (const View& view : study_.views) {
            if (!keep_going_())
                return std::optional<Shown>{};
            if (!specimen->has_hits())
                continue;
            auto hits = TRY(specimen->hits(view));
            shown.hits.push_back(std::move(hits));
        }
        const scene::Scene set = TRY(with(scene_, shown.settings));
        if (const auto cut = specimen->cut_loops(set, study_.views); cut && !cut->empty())
            shown.cut = to_string(*cut, k_safe_iterations);
        shown.seconds = watch.elapsed().wall * 1e-3;
        return std::optional<Shown>(std::move(shown));
    }

    /// Returns the scene as it is, which has no error of its own by definition.
    Result<PictureTruth> unchanged() {
        auto shown = TRY(show({}));
        if (!shown)
            return fail(ErrorCode::check_failed, "interrupted before there was a reference");
        take_first(*std::move(shown));
        PictureTruth found = truth();
        found.standard = {"the scene as it is", 0.0, "exact: settings are compared with the scene itself",
                          too_blind(found.standard.blind, study_.extent.pixels() * study_.views.size()),
                          found.standard.blind};
        found.hit_standard = {};
        found.hits.clear();
        return found;
    }

    /// Draws the first rung, in double if possible.
    Result<void> begin() {
        step_ = study_.first_step;
        const bool to_promote = precision_ == glsl::Precision::single && study_.promote;
        if (to_promote) {
            precision_ = glsl::Precision::promoted;
            auto promoted = show(strictest(study_, step_));
            if (promoted && *promoted && (*promoted)->seconds <= longest_first_step())
                return begin_at(**std::move(promoted));
            not_promoted_ = !promoted    ? to_string(promoted.error())
                            : !*promoted ? "interrupted"
                                         : fmt::format("in double it took {:.0f} s", (*promoted)->seconds);
            precision_ = glsl::Precision::single;
        }
        auto first = TRY(show(strictest(study_, step_)));
        if (!first)
            return fail(ErrorCode::check_failed, "interrupted before there was a reference");
        return begin_at(*std::move(first));
    }

    /// If the driver cuts loops at these settings, goes back to coarser ones at which it does not, and begins
    /// two steps below, so that there are changes to judge by.
    Result<void> begin_at(Shown first) {
        int back = 0;
        while (!first.cut.empty()) {
            stopped_ = first.cut + " with " + to_string(first.settings);
            const std::vector<Setting> coarser = strictest(study_, step_ - 1);
            if (coarser == first.settings || back == 2 * k_most_refinements)
                return fail(ErrorCode::check_failed, "no reference: " + stopped_ + "; give smaller numbers");
            --step_;
            ++back;
            auto next = TRY(show(coarser));
            if (!next)
                return fail(ErrorCode::check_failed, "interrupted before there was a reference");
            first = *std::move(next);
        }
        for (int below = 0; back > 0 && below < 2; ++below) {
            const std::vector<Setting> coarser = strictest(study_, step_ - 1);
            if (coarser == first.settings)
                break;
            auto next = TRY(show(coarser));
            if (!next)
                break;
            --step_;
            first = *std::move(next);
        }
        take_first(std::move(first));
        return {};
    }

    void take_first(Shown shown) {
        first_ = last_ = std::move(shown);
        blind_.resize(first_.pictures.size());
        note_blind(first_);
    }

    void note_blind(const Shown& shown) {
        for (size_t view = 0; view < shown.pictures.size(); ++view)
            add_blind(shown.pictures[view], blind_[view]);
    }

    /// Returns how much of the pictures is not finite, if that is too much for a reference; else an empty
    /// text.
    std::string broken(const Shown& shown) const {
        size_t blind = 0;
        for (const image::Image& picture : shown.pictures) {
            PixelMask mask;
            add_blind(picture, mask);
            blind += size_t(std::ranges::count(mask, true));
        }
        return too_blind(blind, study_.extent.pixels() * study_.views.size());
    }

    double apart(What what, const Shown& a, const Shown& b) const {
        return what == What::pictures ? pooled_rmse(a.pictures, b.pictures, blind_)
                                      : rms_of_hits(a.hits, b.hits, study_.extent);
    }

    double rounding(What what) const {
        const double noise = precision_ == glsl::Precision::single ? k_float_noise : k_double_noise;
        return noise * (what == What::pictures ? noise_of(first_.pictures, blind_) : noise_of(first_.hits));
    }

    std::vector<double>& changes(What what) { return what == What::pictures ? changes_ : hit_changes_; }

    Remainder remainder(What what) { return remainder_of(changes(what), rounding(what)); }

    /// Returns whether further steps would not improve the estimate.
    bool is_settled(What what) {
        const Remainder left = remainder(what);
        if (left.still || !left.error || changes(what).size() < k_wanted_changes)
            return left.still;
        if (study_.enough && what == What::pictures)
            return *left.error <= *study_.enough;
        return named() || *left.error <= k_settled * apart(what, first_, last_);
    }

    /// Draws the next rung; returns false if it was the last one.
    bool step_up() {
        const double longest = changes_.size() < 2 ? longest_first_step() : study_.longest_step;
        if (step_ >= k_most_refinements)
            return false;
        if (last_.seconds > longest) {
            stopped_ = fmt::format("a step took {:.0f} s", last_.seconds);
            return false;
        }
        std::vector<Setting> settings = strictest(study_, step_ + 1);
        if (settings == last_.settings)
            return false;
        auto next = show(settings);
        if (!next || !*next) {
            stopped_ =
                next ? "interrupted" : fmt::format("the scene does not compile with {}", to_string(settings));
            return false;
        }
        if (!(*next)->cut.empty()) {
            stopped_ = fmt::format("{} with {}", (*next)->cut, to_string(settings));
            at_limit_ = true;
            return false;
        }
        if (const std::string why = broken(**next); !why.empty() && broken(last_).empty()) {
            stopped_ = fmt::format("{} with {}", why, to_string(settings));
            at_limit_ = true;
            return false;
        }
        ++step_;
        note_blind(**next);
        changes_.push_back(apart(What::pictures, last_, **next));
        if (has_hits())
            hit_changes_.push_back(apart(What::hits, last_, **next));
        last_ = **std::move(next);
        return !(is_settled(What::pictures) && (!has_hits() || is_settled(What::hits)));
    }

    /// Returns the pictures of settings off the ladder, drawn once for pictures and hits; nullptr if that
    /// fails.
    const Shown* shown_beside(const std::vector<Setting>& settings) {
        const auto [place, is_new] = beside_.try_emplace(to_string(settings));
        if (is_new)
            if (auto shown = show(settings); shown && *shown && (*shown)->cut.empty())
                place->second = *std::move(shown);
        return place->second ? &*place->second : nullptr;
    }

    /// If nothing changes any more, settings off the ladder must not change it either. The own error is 0 if
    /// all of them agree to the bit and no ray was stopped by a count; else the last changes before show how
    /// much a limit inside the scene may hide.
    Remainder look_around(What what, Remainder still) {
        const int step = at_limit_ ? step_ - 1 : step_; // settings beside the last step would be cut, too
        bool same_bits = changes(what).back() == 0;
        for (const bool second : {false, true}) {
            const std::vector<Setting> settings = beside(study_, step, second);
            if (settings == last_.settings)
                continue;
            const Shown* const other = shown_beside(settings);
            if (!other)
                return {{}, fmt::format("it could not be drawn with {}", to_string(settings)), false};
            const double change = apart(what, last_, *other);
            if (!(change <= rounding(what)))
                return {
                    {},
                    fmt::format("it does not converge: {} and {} show the same, but {} differs by {:.2g}{}",
                                to_string(strictest(study_, step_ - 1)), to_string(last_.settings),
                                to_string(settings), change, question_of_even(what, step)),
                    false};
            same_bits = same_bits && change == 0;
            still.how += fmt::format("; {} shows the same", to_string(settings));
        }
        if (same_bits && precision_ != glsl::Precision::single && rays_end()) {
            still.error = 0;
            still.how += ", to the bit, and no loop ended by its count";
            return still;
        }
        return look_back(what, std::move(still));
    }

    /// If settings beside the ladder differ only where an even number became odd, returns the question
    /// whether it must be even.
    std::string question_of_even(What what, int step) {
        Study even = study_;
        for (const std::string& name : knobs_with_even_values(study_))
            if (std::ranges::find(even.even, name) == even.even.end())
                even.even.push_back(name);
        if (even.even.size() == study_.even.size())
            return {};
        for (const bool second : {false, true}) {
            const Shown* const other = shown_beside(beside(even, step, second));
            if (!other || !(apart(what, last_, *other) <= rounding(what)))
                return {};
        }
        return fmt::format(", and {} does not: if {} must be even, say so with --even {}",
                           to_string(beside(even, step, false)), even.even.back(), even.even.back());
    }

    /// Returns whether every loop that the study's knobs concern ended by what it computes, in all views, not
    /// by its count.
    bool rays_end() {
        Specimen* const specimen = specimen_.at(last_.settings, precision_).value_or(nullptr);
        if (!specimen)
            return false;
        for (const View& view : study_.views) {
            const auto ends = specimen->loop_ends(view);
            if (!ends || std::ranges::any_of(*ends, [&](const LoopEnd& end) {
                    const bool concerned =
                        !specimen_.has_uniforms() ||
                        std::ranges::any_of(text::tokenize(end.text), [&](const text::Token& token) {
                            return token.text.starts_with("tidemark_setting_") ||
                                   std::ranges::find(last_.settings, token.text, &Setting::name) !=
                                       last_.settings.end();
                        });
                    return end.cut || (end.counted_out && concerned);
                }))
                return false;
        }
        return true;
    }

    /// Returns the last two changes above rounding, the later first: on the ladder, then below it.
    std::vector<double> last_moves(What what) {
        std::vector<double> moves;
        for (size_t i = changes(what).size(); i-- > 0 && moves.size() < 2;)
            if (changes(what)[i] > rounding(what))
                moves.push_back(changes(what)[i]);
        const Shown* stricter = &first_;
        for (int back = 1; back <= k_most_refinements && moves.size() < 2; ++back) {
            const std::vector<Setting> settings = strictest(study_, -back);
            if (settings == stricter->settings)
                break;
            const Shown* const coarser = shown_beside(settings);
            if (!coarser)
                break;
            if (const double change = apart(what, *stricter, *coarser); !(change <= rounding(what)))
                moves.push_back(change);
            stricter = coarser;
        }
        return moves;
    }

    Remainder look_back(What what, Remainder still) {
        const std::vector<double> moves = last_moves(what);
        if (moves.empty())
            return still;
        const Remainder trend =
            moves.size() > 1 ? remainder_of({moves[1], moves[0]}, rounding(what)) : Remainder{};
        still.error = std::max(*still.error, trend.error.value_or(moves[0]));
        still.how +=
            fmt::format("; the change before was {:.2g}; if only a limit stopped it, {:.2g} is missing",
                        moves[0], *still.error);
        return still;
    }

    /// Returns the estimate of the truth's own error.
    Standard standard(What what) {
        Standard standard;
        const Shown& best = named() ? first_ : last_;
        standard.method =
            fmt::format("the scene itself with {}, {}{}", to_string(best.settings),
                        precision_ == glsl::Precision::single ? "in single precision" : "promoted to double",
                        best.kept_hashes.empty()
                            ? ""
                            : fmt::format(" (hashes kept in floats: {})", fmt::join(best.kept_hashes, ", ")));
        Remainder left = remainder(what);
        if (left.still)
            left = look_around(what, std::move(left));
        if (!stopped_.empty())
            left.how += "; " + stopped_;
        standard.check = changes(what).empty() ? left.how
                                               : fmt::format("{} to {}: {}", to_string(first_.settings),
                                                             to_string(last_.settings), left.how);
        if (left.error)
            standard.uncertainty = *left.error + (named() ? apart(what, first_, last_) : 0.0);
        else if (!named())
            standard.none = left.how;
        if (what == What::pictures && best.buffered)
            widen_by_buffers(standard, best);
        return standard;
    }

    /// Buffers hold floats in any precision: adds what their rounding does to the picture.
    void widen_by_buffers(Standard& standard, const Shown& best) {
        double share = 0;
        const auto scene = with_nudged_buffers(scene_, precision_, share);
        auto specimen =
            scene ? Specimen::create(*scene, {best.settings, precision_}, study_.extent, HitSource::none)
                  : Result<Specimen>(fail(ErrorCode::load, "a buffer has no mainImage of its own"));
        const double change =
            specimen ? pooled_rmse(best.pictures, specimen->pictures(study_.views), blind_) : std::nan("");
        if (!std::isfinite(change)) {
            standard.check += "; its buffers are stored as floats, what that changes is unknown";
            return;
        }
        const double rounding = share * change;
        standard.check +=
            fmt::format("; its buffers are stored as floats, which rounds the picture by {:.2g}, "
                        "as trial changes of them show",
                        rounding);
        if (standard.uncertainty)
            *standard.uncertainty += rounding;
    }

    void refuse_blind(Standard& standard, size_t blind) const {
        standard.blind = blind;
        if (std::string why = too_blind(blind, study_.extent.pixels() * study_.views.size()); !why.empty())
            standard.none = std::move(why);
    }

    PictureTruth truth() {
        PictureTruth truth;
        truth.standard = standard(What::pictures);
        if (has_hits())
            truth.hit_standard = standard(What::hits);
        Shown best = named() ? first_ : last_;
        size_t blind = 0, blind_hits = 0;
        for (const PixelMask& view : blind_)
            blind += size_t(std::ranges::count(view, true));
        for (const Hits& view : best.hits)
            blind_hits += size_t(
                std::ranges::count_if(view.distance, [](double distance) { return std::isnan(distance); }));
        refuse_blind(truth.standard, blind);
        refuse_blind(truth.hit_standard, blind_hits);
        truth.settings = std::move(best.settings);
        truth.views = std::move(best.pictures);
        truth.blind = std::move(blind_);
        truth.hits = std::move(best.hits);
        truth.precision = precision_;
        truth.step = step_;
        truth.not_promoted = std::move(not_promoted_);
        return truth;
    }

    const scene::Scene& scene_;
    const Study& study_;
    const KeepGoing& keep_going_;
    glsl::Precision precision_;
    TurnedSpecimen specimen_;
    std::string not_promoted_;
    std::string stopped_;   ///< why the ladder ends although it could continue
    bool at_limit_ = false; ///< one step further the driver would cut loops, or the numbers break
    Shown first_;           ///< the requested settings, or the study's strictest
    Shown last_;
    int step_ = 0; ///< step of `last_`
    std::map<std::string, std::optional<Shown>> beside_;
    std::vector<double> changes_;
    std::vector<double> hit_changes_;
    std::vector<PixelMask> blind_; ///< by view
};

} // namespace

Result<PictureTruth> converged_pictures(const scene::Scene& scene, const Study& study,
                                        const KeepGoing& keep_going) {
    return Ladder(scene, study, keep_going).climb();
}

} // namespace tidemark::lab
