#include "lab/fix.hpp"

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/text_findings.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace tidemark::lab {
namespace {

using Kind = Finding::Kind;

/// Largest mean FLIP of a fix that should keep the picture. A guard only changes pixels that were undefined;
/// finite pixels may change if a clamp masked their NaN.
constexpr double k_most_flip = 0.02;
/// Share of changed pixels allowed in addition to the fault's, which counts visible changes only.
constexpr double k_rounding = 0.01;
/// Largest share of changed pixels that a fix of undefined calls may have. What the picture should be there
/// is unknown, so the user has to decide beyond this.
constexpr double k_most_undefined = 0.1;
/// Largest mean difference from the picture in double, of 1, over samples that were not finite in float.
constexpr double k_most_gap = 0.1;
/// Largest part of a rounding fault that may remain; rounding differently alone changes it somewhat.
constexpr double k_most_left = 0.5;
constexpr Extent k_timed_extent{320, 180};
constexpr int k_timed_frames = 5;

bool is_finite_pixel(std::span<const float> pixel) {
    return std::ranges::all_of(pixel, [](float sample) { return std::isfinite(sample); });
}

std::span<const float> pixel_of(const image::Image& picture, size_t pixel) {
    const auto channels = size_t(picture.channels);
    return picture.f32().subspan(pixel * channels, channels);
}

double count_not_finite(const std::vector<PassPicture>& passes) {
    size_t count = 0;
    for (const PassPicture& pass : passes)
        for (size_t i = 0; i < pass.picture.extent.pixels(); ++i)
            count += !is_finite_pixel(pixel_of(pass.picture, i));
    return double(count);
}

/// Returns the number of places that `find(pass)` returns, over all passes.
template <class Find>
Result<double> count_in_texts(ProbeBench& bench, Find find) {
    size_t count = 0;
    for (const PassText& pass : TRY(read_texts(bench, true)))
        count += find(pass).size();
    return double(count);
}

Result<double> count_without_value(ProbeBench& bench) {
    return count_in_texts(bench,
                          [](const PassText& pass) { return glsl::find_unassigned(*pass.text, pass.facts); });
}

Result<double> count_miscounting(ProbeBench& bench) {
    return count_in_texts(
        bench, [](const PassText& pass) { return glsl::miscounting_loops(*pass.text, pass.facts); });
}

Result<double> count_divergent(ProbeBench& bench) {
    return count_in_texts(bench, [&](const PassText& pass) {
        auto found =
            glsl::find_divergent(*pass.text, pass.facts, which_have_mipmaps(bench.scene().passes[pass.pass]));
        std::erase_if(found, &glsl::Divergent::harmless);
        return found;
    });
}

Result<double> count_out_of_bounds(ProbeBench& bench, bool negative) {
    return double(std::ranges::count_if(TRY(explore(bench))->outside, [&](const Outside& each) {
        return each.bound && (each.site.kind == glsl::DomainKind::negative) == negative;
    }));
}

Result<double> count_wrong_edges(ProbeBench& bench) {
    return count_in_texts(
        bench, [](const PassText& pass) { return glsl::find_wrong_edges(*pass.text, pass.facts); });
}

Result<double> count_seams(ProbeBench& bench) {
    const auto texts = TRY(read_texts(bench, true));
    return double(TRY(find_seams(bench, texts)).size());
}

Result<double> undefined_percent(ProbeBench& bench, const std::vector<PictureView>& views) {
    const auto texts = TRY(read_texts(bench, false));
    double percent = 0;
    for (const UndefinedCall& each : TRY(find_undefined(bench, texts, views)))
        percent += each.percent;
    return percent;
}

Result<double> proved_wrong_percent(ProbeBench& bench) {
    const auto pass = TRY(marching_pass(bench));
    if (!pass)
        return fail(ErrorCode::check_failed, "its march is no longer found");
    return wrong_percent(TRY(count_proved(bench, *pass)));
}

std::string name_of(Kind kind) {
    switch (kind) {
    case Kind::no_value: return "reads without a value";
    case Kind::not_finite: return "pixels that are not finite";
    case Kind::undefined: return "percent of the pixels that show an undefined result";
    case Kind::first_hit: return "percent of the rays that step over their first hit or miss it";
    case Kind::budget: return "percent of the rays that run out of steps";
    case Kind::hash: return "hashes of large sines";
    case Kind::counter: return "loops that miscount";
    case Kind::divergence: return "derivatives where neighbours may have taken another branch";
    case Kind::bounds: return "places out of bounds";
    case Kind::remainder: return "divisions of negative integers";
    case Kind::edges: return "calls with edges in the wrong order";
    case Kind::seam: return "look-ups whose mipmap is chosen across a jump";
    case Kind::rounding: return "percent of the pixels that visibly differ from double precision";
    }
    return {};
}

Result<double> count_sine_hashes(ProbeBench& bench) {
    return double(std::ranges::count(TRY(bench.hashes()), glsl::HashKind::sine, &glsl::KeptHash::kind));
}

Result<double> exhausted_percent(ProbeBench& bench) {
    if (!bench.has_hits())
        return fail(ErrorCode::check_failed, bench.hit_problem());
    return TRY(most_running_out(bench, usual_views())).percent;
}

bool is_of_rays(Kind kind) {
    return kind == Kind::first_hit || kind == Kind::budget;
}

/// Returns whether the fault is fixed. For rays the probes' limits suffice: the last wrong rays are a matter
/// of silhouettes, and of run time.
bool is_mended(Kind kind, const Fault& fault, const ProbeBench& bench) {
    if (!(fault.after < fault.before))
        return false;
    if (kind == Kind::rounding)
        return fault.after <= k_most_left * fault.before;
    if (!is_of_rays(kind))
        return true;
    return fault.after <=
           (kind == Kind::first_hit
                ? k_most_wrong_percent
                : most_allowed(bench, bench.promises().most_exhausted_percent, "most_exhausted_percent"));
}

/// Adds the pixels of one pass in one situation; returns false if a finite pixel has become non-finite.
bool compare(const image::Image& before, const image::Image& after, Judgement& judgement) {
    for (size_t i = 0; i < before.extent.pixels(); ++i) {
        const auto left = pixel_of(before, i), right = pixel_of(after, i);
        if (!is_finite_pixel(left))
            continue;
        if (!is_finite_pixel(right))
            return false;
        ++judgement.compared;
        judgement.changed += std::memcmp(left.data(), right.data(), left.size_bytes()) != 0;
    }
    return true;
}

Result<bool> compare_all(DrawnScene& before, DrawnScene& after, const std::vector<FrameState>& states,
                         Judgement& judgement) {
    for (const FrameState& state : states) {
        const auto &left = *TRY(before.passes(state)), &right = *TRY(after.passes(state));
        if (left.size() != right.size())
            return false;
        const size_t changed = judgement.changed, compared = judgement.compared;
        for (size_t pass = 0; pass < left.size(); ++pass)
            if (!compare(left[pass].picture, right[pass].picture, judgement))
                return false;
        if (judgement.compared > compared)
            judgement.largest_share =
                std::max(judgement.largest_share,
                         double(judgement.changed - changed) / double(judgement.compared - compared));
        const image::Image &shown = left.back().picture, &now = right.back().picture;
        if (judgement.changed > changed && !image::census(shown).first_non_finite)
            judgement.flip = std::max(
                judgement.flip, image::flip(image::without_alpha(shown), image::without_alpha(now)).mean);
    }
    return true;
}

/// Compares the fixed samples with the picture in double where only float was not finite.
bool is_as_in_double(const InBoth& before, const image::Image& cured) {
    double gap = 0;
    size_t samples = 0;
    for (size_t i = 0; i < cured.samples(); ++i) {
        if (std::isfinite(before.floats.f32()[i]))
            continue;
        ++samples;
        if (const double truth = before.doubles.f32()[i]; std::isfinite(truth))
            gap += std::abs(std::clamp(truth, 0.0, 1.0) - std::clamp(double(cured.f32()[i]), 0.0, 1.0));
    }
    return gap <= k_most_gap * double(samples);
}

/// Computes the RMSE of float against double for both scenes, over the samples that are finite in all four
/// pictures. Returns false if the picture in double contradicts the fix.
bool compare_errors(DrawnScene& before, DrawnScene& after, const FrameState& state, Judgement& judgement) {
    const auto left = before.in_both(state), right = after.in_both(state);
    if (!left || !right)
        return true;
    if (!is_as_in_double(*left, right->floats))
        return false;
    double squares[2]{};
    size_t samples = 0;
    for (size_t i = 0; i < left->floats.samples(); ++i) {
        const double gaps[2]{left->gap(i), right->gap(i)};
        if (!std::isfinite(gaps[0]) || !std::isfinite(gaps[1]))
            continue;
        ++samples;
        for (const int which : {0, 1})
            squares[which] += gaps[which] * gaps[which];
    }
    if (samples == 0)
        return true;
    judgement.error_before = std::sqrt(squares[0] / double(samples));
    judgement.error_after = std::sqrt(squares[1] / double(samples));
    return true;
}

/// Returns whether the fix changed the picture. Pixels that showed something undefined may change.
bool is_another(const Judgement& judgement, Kind kind) {
    if (kind == Kind::no_value || kind == Kind::bounds)
        return judgement.changed > 0;
    // These fixes are meant to change it; what a GPU makes of a negative integer's remainder may be any
    // number.
    if (kind == Kind::hash || kind == Kind::rounding || kind == Kind::remainder)
        return false;
    if (is_of_rays(kind)) // a ray that hits another surface may change its pixel completely
        return judgement.flip > k_most_flip + judgement.fault.before / 100;
    const bool by_the_fault =
        kind == Kind::undefined &&
        judgement.largest_share <= std::min(judgement.fault.before / 100 + k_rounding, k_most_undefined);
    return judgement.flip > k_most_flip && !by_the_fault;
}

/// Returns whether both scenes look the same in double, that is, without visible rounding.
Result<bool> agree_in_double(DrawnScene& before, DrawnScene& after, const FrameState& state) {
    for (const FrameState& each : {state, plain_state()}) {
        const InBoth left = TRY(before.in_both(each)), right = TRY(after.in_both(each));
        if (p99_difference(left.doubles, right.doubles) > k_visible_gap)
            return false;
    }
    return true;
}

Result<void> time_both(ProbeBench& before, ProbeBench& after, Judgement& judgement) {
    if (TRY(before.has_feedback()))
        return {};
    std::vector<double> times[2];
    for (int frame = 0; frame <= k_timed_frames; ++frame)
        for (ProbeBench* const bench : {&before, &after}) {
            const Stopwatch watch;
            TRY(bench->picture(state_at(frame, k_timed_extent)));
            if (frame > 0) // the first frame includes compilation
                times[bench == &after].push_back(watch.elapsed().cpu);
        }
    judgement.milliseconds_before = median(times[0]);
    judgement.milliseconds_after = median(times[1]);
    return {};
}

} // namespace

Result<const std::vector<PassPicture>*> DrawnScene::passes(const FrameState& state) {
    for (const auto& [drawn, pictures] : drawn_)
        if (drawn == state)
            return &pictures;
    auto pictures = TRY(bench_.passes(state));
    return &drawn_.emplace_back(state, std::move(pictures)).second;
}

Result<InBoth> DrawnScene::in_both(const FrameState& state) {
    for (const auto& [drawn, pictures] : in_both_)
        if (drawn == state)
            return pictures;
    auto floats = TRY(bench_.picture(state));
    auto doubles = TRY(bench_.picture(state, glsl::Precision::promoted));
    return in_both_.emplace_back(state, InBoth{std::move(floats), std::move(doubles)}).second;
}

Result<ShownError> DrawnScene::shown_error() {
    ShownError error;
    double squares = 0;
    size_t samples = 0;
    for (const double seconds : {0.0, 1.0, 10.0}) {
        const auto [floats, doubles] = TRY(in_both(state_at(seconds)));
        error.pixels += floats.extent.pixels();
        for (size_t pixel = 0; pixel < floats.extent.pixels(); ++pixel)
            for (size_t i = 0; i < 3; ++i) {
                const double one = pixel_of(floats, pixel)[i], other = pixel_of(doubles, pixel)[i];
                if (!std::isfinite(one) || !std::isfinite(other))
                    continue;
                const double gap = std::abs(std::clamp(one, 0.0, 1.0) - std::clamp(other, 0.0, 1.0));
                squares += gap * gap;
                error.worst = std::max(error.worst, gap);
                ++samples;
            }
    }
    if (samples == 0)
        return fail(ErrorCode::check_failed, "no colour of the picture is finite");
    error.rmse = std::sqrt(squares / double(samples));
    return error;
}

Result<double> DrawnScene::fault(const Finding& finding, const std::vector<PictureView>& views) {
    if (finding.kind == Kind::not_finite)
        return count_not_finite(*TRY(passes(*finding.where)));
    if (finding.kind == Kind::rounding) {
        const InBoth pictures = TRY(in_both(*finding.where));
        return visibly_different_percent(pictures.floats, pictures.doubles);
    }
    const auto known = faults_.find(finding.kind);
    if (known != faults_.end())
        return known->second;
    return faults_[finding.kind] = TRY(fault_of_scene(finding.kind, views));
}

Result<double> DrawnScene::fault_of_scene(Kind kind, const std::vector<PictureView>& views) {
    switch (kind) {
    case Kind::no_value: return count_without_value(bench_);
    case Kind::first_hit: return proved_wrong_percent(bench_);
    case Kind::budget: return exhausted_percent(bench_);
    case Kind::hash: return count_sine_hashes(bench_);
    case Kind::counter: return count_miscounting(bench_);
    case Kind::divergence: return count_divergent(bench_);
    case Kind::bounds: return count_out_of_bounds(bench_, false);
    case Kind::remainder: return count_out_of_bounds(bench_, true);
    case Kind::edges: return count_wrong_edges(bench_);
    case Kind::seam: return count_seams(bench_);
    case Kind::not_finite:
    case Kind::rounding: // both depend on a situation
    case Kind::undefined: break;
    }
    return undefined_percent(bench_, views);
}

Result<std::optional<Judgement>> judge(DrawnScene& before, DrawnScene& after, const Finding& finding,
                                       const std::vector<PictureView>& views) {
    std::optional<Judgement> none;
    Judgement judgement{{name_of(finding.kind), TRY(before.fault(finding, views)), 0}};
    judgement.fault.after = TRY(after.fault(finding, views));
    if (!is_mended(finding.kind, judgement.fault, before.bench()))
        return none;
    std::vector<FrameState> states = usual_moments();
    if (finding.where)
        states.push_back(*finding.where);
    if (!TRY(compare_all(before, after, states, judgement)))
        return none;
    if (is_another(judgement, finding.kind))
        return none;
    if (finding.kind == Kind::rounding && !TRY(agree_in_double(before, after, *finding.where)))
        return none;
    if (!compare_errors(before, after, finding.where.value_or(plain_state()), judgement))
        return none;
    TRY(time_both(before.bench(), after.bench(), judgement));
    return judgement;
}

namespace {

constexpr int k_most_rounds = 8;

/// A probe, and the findings that repeat it.
struct Covered {
    std::string_view probe;
    Kind kind;
};
constexpr Covered k_covered[] = {
    {"times", Kind::not_finite},    {"frames", Kind::not_finite},    {"mouse", Kind::not_finite},
    {"sizes", Kind::not_finite},    {"inputs", Kind::not_finite},    {"knobs", Kind::not_finite},
    {"search", Kind::not_finite},   {"unassigned", Kind::no_value},  {"undefined", Kind::undefined},
    {"bounds", Kind::bounds},       {"bounds", Kind::remainder},     {"divergence", Kind::divergence},
    {"counters", Kind::counter},    {"edges", Kind::edges},          {"seams", Kind::seam},
    {"first_hit", Kind::first_hit}, {"step_scale", Kind::first_hit}, {"overstep", Kind::first_hit},
    {"budget", Kind::budget},       {"turns", Kind::budget},         {"grazing", Kind::budget},
    {"horizon", Kind::rounding},    {"hashes", Kind::hash},
};

class Mender {
public:
    Mender(const scene::Scene& scene, const Promises& promises, const Mending& mending)
        : scene_(scene), promises_(promises), mending_(mending),
          now_(std::make_unique<DrawnScene>(scene, promises)) {}

    Result<void> run() {
        if (mending_.measured)
            mending_.measured(now_->shown_error());
        TRY(now_->bench().compiled()); // a compile error is the result
        for (int round = 0; round < k_most_rounds; ++round) {
            refused_.clear();
            refused_kinds_.clear();
            const CurableFindings found = TRY(find_curable(now_->bench(), mending_.hashes));
            if (!found.left_out.empty())
                refused_[found.left_out] = "nothing was searched";
            if (!TRY(mend_all(found)))
                break;
        }
        for (const auto& [finding, why] : refused_)
            mending_.remains({finding, why});
        return report_others();
    }

private:
    /// Reports what the probes of `check` find in the fixed scene and no fix exists for.
    Result<void> report_others() {
        std::optional<Result<Answer>> hashes; // run at most once
        const auto ask = [&](const Probe& probe) {
            if (probe.name != "hashes")
                return probe.ask(now_->bench());
            if (!hashes)
                hashes = probe.ask(now_->bench());
            return *hashes;
        };
        const Probe& of_hashes = *std::ranges::find(all_probes(), "hashes", &Probe::name);
        for (const Probe& probe : all_probes()) {
            if (promises_.skip.contains(std::string(probe.name)))
                continue;
            if (std::ranges::any_of(k_covered, [&](const Covered& each) {
                    return each.probe == probe.name && refused_kinds_.contains(each.kind);
                }))
                continue;
            const auto answer = ask(probe);
            if (!answer || (answer->verdict != Verdict::fail && answer->verdict != Verdict::warn))
                continue;
            const bool of_sines = probe.name == "hashes" || probe.name == "sine" || probe.name == "rounding";
            const bool mendable = of_sines && !mending_.hashes && has_any(ask(of_hashes));
            mending_.remains({fmt::format("{}: {}", probe.name, answer->sentence),
                              mendable ? "--hashes replaces them, which gives another picture"
                                       : "no fix is known for this probe's findings"});
        }
        return {};
    }

    /// Tries to fix all findings; returns whether any was fixed.
    Result<bool> mend_all(const CurableFindings& found) {
        bool mended = false;
        for (const Finding& finding : found.all) {
            if (finding.where && finding.kind == Finding::Kind::not_finite &&
                TRY(now_->fault(finding, found.views)) == 0)
                continue; // fixed by an earlier fix
            const auto offer = TRY(first_better(finding, found.views));
            if (!offer)
                continue;
            mended = true;
            mending_.offered(*offer, cures_);
        }
        return mended;
    }

    static bool has_any(const Result<Answer>& answer) {
        return answer && answer->verdict != Verdict::pass && answer->verdict != Verdict::not_applicable;
    }

    Result<std::optional<Offer>> first_better(const Finding& finding, const std::vector<PictureView>& views) {
        std::string& why = refused_[finding.sentence];
        refused_kinds_.insert(finding.kind);
        why = finding.cures.empty() ? "no fix is known, or its text cannot be changed" : "";
        for (const glsl::Cure& cure : finding.cures) {
            cures_.push_back(cure);
            auto scene = changed(scene_, cures_);
            if (!scene || !mending_.can_be_written(cures_)) {
                why = cures_.size() > 1
                          ? "an earlier fix changed the same text: write that one, then run again"
                          : "its text is not found in a file of the scene";
            } else {
                auto next = std::make_unique<DrawnScene>(*std::move(scene), promises_);
                const auto judgement = judge(*now_, *next, finding, views);
                if (judgement && *judgement) {
                    refused_.erase(finding.sentence);
                    now_ = std::move(next);
                    return Offer{finding.sentence, **judgement};
                }
                why = judgement ? "no known fix helps without changing the rest"
                                : "the fixed text is refused: " + to_string(judgement.error());
            }
            cures_.pop_back();
        }
        return std::optional<Offer>();
    }

    const scene::Scene& scene_;
    const Promises& promises_;
    const Mending& mending_;
    std::unique_ptr<DrawnScene> now_;
    std::vector<glsl::Cure> cures_{};
    std::map<std::string, std::string> refused_{};
    std::set<Kind> refused_kinds_{}; ///< of the findings of the last round
};

} // namespace

Result<void> mend(const scene::Scene& scene, const Promises& promises, const Mending& mending) {
    return Mender(scene, promises, mending).run();
}

} // namespace tidemark::lab
