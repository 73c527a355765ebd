#include "lab/conduct.hpp"

#include "base/error.hpp"
#include "lab/march_hits.hpp"
#include "lab/outcome.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/study.hpp"
#include "lab/truth.hpp"
#include "render/gl_context.hpp"
#include "shader/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace tidemark::lab {
namespace {

ProvedHits no_hits(std::string why) {
    return {.why_not = std::move(why)};
}

Standard standard_of(const PassFunction& function, const std::vector<Setting>& settings,
                     const std::vector<TrueHits>& views) {
    const SourceLocation where = function.locate(function.loops().front().line);
    Standard standard;
    standard.method = fmt::format(
        "{} the distance that {}:{} tests{}, proved from the text by interval "
        "arithmetic on every piece of a ray, in real arithmetic on rays set up in double",
        views.front().surface == proof::Surface::zero ? "first zeros of"
                                                      : "first places below the threshold of",
        where.file, where.line, settings.empty() ? "" : fmt::format(" with {}", to_string(settings)));
    double squares = 0;
    size_t looked_at = 0, unknown = 0;
    for (const TrueHits& view : views) {
        squares += view.half_width * view.half_width * double(view.looked_at);
        looked_at += view.looked_at;
        unknown += view.unknown;
    }
    standard.uncertainty = std::sqrt(squares / double(std::max<size_t>(1, looked_at)));
    standard.check = fmt::format(
        "{} of {} rays, evenly spread; each hit is known to lie between two places, {} are unknown",
        looked_at, views.size() * views.front().hits.size(), unknown);
    standard.blind = unknown;
    return standard;
}

} // namespace

Result<ProvedHits> proved_hits(const scene::Scene& scene, const Study& study, const KeepGoing& keep_going) {
    const std::vector<Setting> settings = strictest(study, 0);
    const scene::Scene set = TRY(with(scene, settings));
    const size_t image = set.image_index();
    const auto function = PassFunction::create(set, set.passes[image]);
    if (!function)
        return no_hits("the text cannot be analysed: " + function.error().message);
    if (function->loops().empty())
        return ProvedHits{{}, "no ray-marching loop found in Image", false};
    auto renderer =
        TRY(render::Renderer::create(set, {.extent = study.extent, .samples = image::SampleType::f32}));
    std::vector<TrueHits> views;
    HitTruth truth;
    for (const View& view : study.views) {
        const render::FrameState state = state_of(view, study.extent);
        render::FrameStepper(renderer, state).draw(state.frame);
        auto hits = true_hits({*function, renderer, image, inputs_of(state)},
                              study.proof_seconds / double(study.views.size()), keep_going);
        if (!hits)
            return no_hits("interrupted");
        if (double(hits->unknown) > k_most_blind * double(hits->looked_at))
            return no_hits(fmt::format("{} of {} rays cannot be decided by proof from the text",
                                       hits->unknown, hits->looked_at));
        truth.views.push_back(hits->hits);
        truth.footprints.push_back(plain_footprint(study.extent));
        views.push_back(*std::move(hits));
    }
    truth.standard = standard_of(*function, settings, views);
    return ProvedHits{.truth = std::move(truth)};
}

namespace {

class Conductor {
public:
    Conductor(const scene::Scene& scene, const Study& study, const Timing& timing, const Watch& watch,
              const Circumstances& circumstances)
        : scene_(scene), timing_(timing), watch_(watch) {
        findings_.set.study = study;
        findings_.set.circumstances = circumstances;
        for (Point& point : points_of(study))
            findings_.set.points.emplace_back().point = std::move(point);
        specimens_.resize(set().points.size());
        sights_.resize(set().points.size());
    }

    Result<Findings> run() {
        TRY(check_settings());
        for (const auto part : {&Conductor::prove_hits, &Conductor::look, &Conductor::find_truth})
            TRY((this->*part)());
        hold_against_truth();
        take_sources_away();
        const bool complete = time_points(
            timing_, watch_,
            [this](size_t point, size_t view, bool ask_gpu) {
                return specimens_[point]->time(study().views[view], ask_gpu);
            },
            findings_.set);
        set().circumstances.complete = complete && !stopped_;
        find_idle(set(), sights_);
        judge(set());
        observe_orders(set());
        findings_.evidence.reference = std::move(truth_.pictures);
        for (Sight& sight : sights_)
            findings_.evidence.pictures.push_back(std::move(sight.pictures));
        return std::move(findings_);
    }

private:
    WorkPrecisionSet& set() { return findings_.set; }
    const Study& study() const { return findings_.set.study; }

    void remark(std::string text) {
        auto& remarks = set().circumstances.remarks;
        if (std::ranges::find(remarks, text) == remarks.end())
            remarks.push_back(std::move(text));
    }

    bool going() {
        stopped_ = stopped_ || !watch_.keep_going();
        return !stopped_;
    }

    /// Unknown names and invalid values are usage errors, so all are checked before the first drawing.
    Result<void> check_settings() {
        std::vector<std::vector<Setting>> all{study().reference, study().model};
        for (const ErrorSource& source : study().sources)
            all.push_back(source.settings);
        for (const WorkPrecision& point : set().points)
            all.push_back(point.point.settings);
        for (const auto& settings : all)
            TRY(with(scene_, settings));
        const std::vector<std::string> names = set_names(set());
        for (const std::string& name : names)
            set().scene_values.push_back({name, value_of(scene_, name)});
        set().held = own_numbers(scene_);
        std::erase_if(set().held, [&](const Setting& setting) {
            return std::ranges::find(names, setting.name) != names.end();
        });
        for (WorkPrecision& point : set().points)
            point.own = &point != &set().points.front() && has_own_values(point.point);
        return {};
    }

    /// Returns whether the settings of a point are the values that the scene has anyway.
    bool has_own_values(const Point& point) {
        return std::ranges::all_of(merged(point.settings), [&](const Setting& setting) {
            const auto own = std::ranges::find(set().scene_values, setting.name, &Setting::name);
            const auto number = number_of(setting.value);
            return own != set().scene_values.end() &&
                   (own->value == setting.value || (number && number == number_of(own->value) &&
                                                    is_int(setting.value) == is_int(own->value)));
        });
    }

    /// Returns the pictures and hits of a recipe, drawn once: without an error source, many points are the
    /// same.
    Result<const Sight*> sight_of(const Recipe& recipe) {
        std::vector<Setting> key = merged(recipe.settings);
        std::ranges::sort(key, {}, &Setting::name);
        const std::string name =
            to_string(key) + (recipe.precision == glsl::Precision::single ? "" : ", in double");
        const auto known = known_sights_.find(name);
        if (known != known_sights_.end())
            return &known->second;
        auto specimen = Specimen::create(scene_, recipe, study().extent, hit_source_);
        auto sight = TRY(specimen ? sight_of(*specimen) : Result<Sight>(fail(specimen.error())));
        return &(known_sights_[name] = std::move(sight));
    }

    Result<Sight> sight_of(Specimen& specimen) {
        Sight sight;
        sight.pictures = specimen.pictures(study().views);
        if (specimen.has_hits())
            sight.hits = TRY(specimen.hits(study().views));
        return sight;
    }

    /// Finds the places of the first hits as far as the text proves them.
    Result<void> prove_hits() {
        if (!study().rays) {
            hit_source_ = HitSource::none;
            return {};
        }
        if (!(study().proof_seconds > 0)) {
            why_no_proof_ = "no proof was requested";
            return {};
        }
        watch_.begin("rays proved", 1);
        auto proved = TRY(proved_hits(scene_, study(), [this] { return going(); }));
        watch_.advance();
        why_no_proof_ = std::move(proved.why_not);
        if (!proved.truth && proved.marches && !glsl::hit_scene(scene_))
            remark("hit errors are not measured: " + why_no_proof_);
        if (!proved.truth)
            return {};
        set().hit_standard = std::move(proved.truth->standard);
        truth_.hits = std::move(proved.truth->views);
        truth_.footprints = std::move(proved.truth->footprints);
        return record_hits();
    }

    /// Records the hits of a scene without mainHit if there is a proof to compare them with. The unchanged
    /// scene, the first point, is recorded.
    Result<void> record_hits() {
        if (glsl::hit_scene(scene_))
            return {};
        auto specimen =
            Specimen::create(scene_, {{}, study().precision}, study().extent, HitSource::main_hit_or_march);
        const View& view = study().views.front();
        if (specimen)
            // first, so that work deferred by the driver counts for the first picture
            specimen->picture(view);
        const auto hits = specimen ? specimen->hits(view) : fail(specimen.error());
        set().hits_recorded = hits.has_value();
        if (hits) {
            hit_source_ = HitSource::main_hit_or_march;
            specimens_.front() = *std::move(specimen);
            return {};
        }
        remark("the march of mainImage is not recorded: " + to_string(hits.error()));
        set().hit_standard = {};
        truth_.hits.clear();
        truth_.footprints.clear();
        return {};
    }

    /// Draws every point in every view.
    Result<void> look() {
        watch_.begin("points drawn", set().points.size());
        for (size_t i = 0; i < set().points.size(); ++i) {
            WorkPrecision& point = set().points[i];
            if (!going()) {
                point.failure = "interrupted";
                continue;
            }
            auto specimen = specimens_[i]
                                ? Result<Specimen>(*std::exchange(specimens_[i], std::nullopt))
                                : Specimen::create(scene_, {point.point.settings, study().precision},
                                                   study().extent, hit_source_);
            auto sight = specimen ? sight_of(*specimen) : Result<Sight>(fail(specimen.error()));
            if (sight)
                point.failure = cut_of(*specimen, point.point.settings);
            if (!sight && i == 0) // the unchanged scene
                return fail(std::move(sight.error()));
            if (sight && i == 0 && !point.failure.empty())
                remark(std::exchange(point.failure, {}) + " in the scene as it is");
            if (sight && point.failure.empty()) {
                point.compile_milliseconds = specimen->compile_milliseconds();
                point.first_draw_milliseconds = specimen->first_draw_milliseconds();
                sights_[i] = *std::move(sight);
                specimens_[i] = *std::move(specimen);
            } else if (!sight) {
                point.failure = to_string(sight.error());
            }
            watch_.advance();
        }
        return {};
    }

    /// Returns which loops the driver cuts at these settings; empty if none.
    std::string cut_of(Specimen& specimen, const std::vector<Setting>& settings) const {
        const auto set = with(scene_, settings);
        const auto cut = set ? specimen.cut_loops(*set, study().views)
                             : Result<std::vector<SourceLocation>>(fail(set.error()));
        return cut && !cut->empty() ? to_string(*cut, k_safe_iterations) : std::string();
    }

    Result<void> find_truth() {
        watch_.begin("the reference", 1);
        auto pictures = converged_pictures(scene_, study(), [this] { return going(); });
        if (!pictures)
            return fail(std::move(pictures.error()));
        truth_recipe_ = {pictures->settings, pictures->precision};
        if (!pictures->not_promoted.empty())
            remark("the reference is in single precision: " + pictures->not_promoted);
        set().picture_standard = std::move(pictures->standard);
        if (set().picture_standard.none.empty()) {
            truth_.pictures = std::move(pictures->views);
            truth_.blind = std::move(pictures->blind);
        }
        if (!truth_.hits.empty())
            check_pictures_by_hits(pictures->hits);
        else if (!pictures->hits.empty())
            take_drawn_hits(*pictures);
        if (study().precision != glsl::Precision::single && set().has_hits())
            allow_for_read_back(set().hit_standard);
        watch_.advance();
        return {};
    }

    /// Takes the hits to which the scene itself converges as the truth, if no march is proved.
    void take_drawn_hits(PictureTruth& drawn) {
        remark("the hits are not proved: " + why_no_proof_ +
               (drawn.hit_standard.none.empty()
                    ? "; they are compared with hits that the scene itself converges to"
                    : ""));
        if (!drawn.hit_standard.none.empty()) {
            remark("no reference for the hits: " + drawn.hit_standard.none);
            return;
        }
        set().hit_standard = std::move(drawn.hit_standard);
        truth_.hits = std::move(drawn.hits);
        truth_.footprints.assign(study().views.size(), plain_footprint(study().extent));
    }

    /// Distances computed in double leave mainHit as floats, so no error is known more precisely than that.
    void allow_for_read_back(Standard& standard) const {
        double squares = 0;
        size_t count = 0;
        for (const Hits& hits : truth_.hits)
            for (const double distance : hits.distance)
                if (distance >= 0) {
                    squares += distance * distance;
                    ++count;
                }
        const double rounding = 0x1p-24 * std::sqrt(squares / double(std::max<size_t>(1, count)));
        if (standard.uncertainty)
            standard.uncertainty = std::max(*standard.uncertainty, rounding);
        standard.check += fmt::format("; distances are read back as floats, precise to {:.2g}", rounding);
    }

    /// If hits are proved, compares the rays of the pictures' reference with them.
    void check_pictures_by_hits(const std::vector<Hits>& hits) {
        if (hits.empty())
            return;
        const HitErrors errors = hit_errors(joined(truth_.hits), joined(hits), joined(truth_.footprints));
        set().picture_standard.check +=
            fmt::format("; its rays compared with the proved hits: RMS {:.2g}, {:.2g} % wrong", errors.rms,
                        errors.wrong_tenth);
    }

    void hold_against_truth() {
        const size_t views = study().views.size();
        watch_.begin("points compared", set().points.size());
        findings_.evidence.causes.resize(set().points.size());
        for (size_t i = 0; i < set().points.size(); ++i) {
            WorkPrecision& point = set().points[i];
            for (size_t view = 0; point.failure.empty() && view < views; ++view) {
                point.views.push_back(outcome_of(sights_[i], truth_, view));
                if (point.views.back().hits)
                    findings_.evidence.causes[i].push_back(
                        cause_map(causes(truth_.hits[view], sights_[i].hits[view]), study().extent));
            }
            if (point.failure.empty())
                point.all = outcome_of_all(sights_[i], truth_, point.views);
            watch_.advance();
        }
    }

    /// Adds each source's settings to those before. Its share is the difference between successive pictures;
    /// the remainder is the algorithm's share.
    void take_sources_away() {
        if ((study().sources.empty() && study().model.empty()) || truth_.pictures.empty())
            return;
        watch_.begin("points split by error source", set().points.size());
        const Sight true_sight{truth_.pictures, truth_.hits};
        const std::optional<Share> model = model_share(true_sight);
        const Stopwatch clock;
        for (size_t i = 0; i < set().points.size() && going(); ++i) {
            if (i > 0 && clock.elapsed().wall * 1e-3 * double(i + 1) / double(i) > timing_.budget) {
                remark(
                    fmt::format("the errors of {} settings are not split by source: it takes longer than the "
                                "time budget",
                                set().points.size() - i));
                break;
            }
            WorkPrecision& point = set().points[i];
            Recipe recipe{point.point.settings, study().precision};
            const Sight* before = &sights_[i];
            for (const ErrorSource& source : study().sources) {
                if (!point.measured())
                    break;
                recipe.settings.insert(recipe.settings.end(), source.settings.begin(), source.settings.end());
                if (source.doubles && recipe.precision == glsl::Precision::single)
                    recipe.precision = glsl::Precision::promoted;
                const auto sight = sight_of(recipe);
                if (!sight) {
                    remark(
                        fmt::format("the share of {} is missing: {}", source.name, to_string(sight.error())));
                    continue;
                }
                point.shares.push_back(share_of(source.name, *before, **sight, truth_));
                before = *sight;
            }
            if (point.measured())
                point.shares.push_back(share_of("algorithm", *before, true_sight, truth_));
            if (point.measured() && model)
                point.shares.push_back(*model);
            watch_.advance();
        }
    }

    /// Returns the change of the reference without the scene's approximations; it is the same for every
    /// point.
    std::optional<Share> model_share(const Sight& true_sight) {
        if (study().model.empty())
            return std::nullopt;
        Recipe recipe = truth_recipe_;
        recipe.settings.insert(recipe.settings.end(), study().model.begin(), study().model.end());
        const auto sight = sight_of(recipe);
        if (sight) // for the picture only: hits depend on the field
            return Share{"model", 0, pooled_rmse((*sight)->pictures, true_sight.pictures, truth_.blind)};
        remark("the share of the model is missing: " + to_string(sight.error()));
        return std::nullopt;
    }

    const scene::Scene& scene_;
    const Timing& timing_;
    const Watch& watch_;
    Findings findings_;
    std::vector<std::optional<Specimen>> specimens_; ///< by point; nullopt for a point that failed
    std::vector<Sight> sights_;
    std::map<std::string, Sight> known_sights_;
    Truth truth_;
    std::string why_no_proof_;
    HitSource hit_source_ = HitSource::main_hit;
    Recipe truth_recipe_; ///< of the reference pictures
    bool stopped_ = false;
};

} // namespace

Result<Findings> conduct(const scene::Scene& scene, const Study& study, const Timing& timing,
                         const Watch& watch, const Circumstances& circumstances) {
    return Conductor(scene, study, timing, watch, circumstances).run();
}

namespace {

/// The points of a study of whole scenes: draws them, compares them with the first, and times them.
class SceneComparison {
public:
    SceneComparison(const Study& study, const Circumstances& circumstances) {
        findings_.set.study = study;
        findings_.set.study.series = {{"changed", Trust::unknown, {}, {}}};
        findings_.set.circumstances = circumstances;
        findings_.set.words.defaults = "the scene as it is";
        findings_.set.picture_standard = {"the scene as it is", 0.0,
                                          "exact: changed scenes are compared with the scene itself"};
    }

    void add(const std::string& label, const scene::Scene& scene, bool own) {
        WorkPrecision& point = findings_.set.points.emplace_back();
        point.point = {own ? size_t(1) : size_t(0), label, label, {}};
        auto specimen = Specimen::create(scene, {}, study().extent);
        if (!specimen)
            point.failure = to_string(specimen.error());
        auto& pictures = findings_.evidence.pictures.emplace_back();
        if (specimen) {
            pictures = specimen->pictures(study().views);
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
        for (auto& pictures : findings_.evidence.pictures)
            pictures = as_shown(std::move(pictures));
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

} // namespace

std::vector<image::Image> as_shown(std::vector<image::Image> pictures) {
    for (image::Image& picture : pictures)
        for (float& sample : picture.f32())
            if (!std::isfinite(sample))
                sample = sample > 0 ? 1.0F : 0.0F;
    return pictures;
}

Result<Truth> truth_of(std::vector<image::Image> pictures) {
    const auto blank = [](const image::Image& picture) {
        PixelMask mask;
        add_blind(picture, mask);
        return std::ranges::count(mask, false) == 0;
    };
    if (std::ranges::all_of(pictures, blank))
        return fail(
            ErrorCode::check_failed,
            "nothing can be compared with the scene's picture: all of its pixels are NaN or infinite");
    return Truth{as_shown(std::move(pictures)), {}, {}, {}};
}

Result<Findings> compare_scenes(const scene::Scene& scene,
                                const std::vector<std::pair<std::string, scene::Scene>>& others,
                                const Study& study, const Timing& timing, const Watch& watch,
                                const Circumstances& circumstances) {
    SceneComparison comparison(study, circumstances);
    comparison.add(std::string(k_defaults), scene, true);
    for (const auto& [label, other] : others)
        if (watch.keep_going())
            comparison.add(label, other, false);
    return comparison.run(timing, watch);
}

} // namespace tidemark::lab
