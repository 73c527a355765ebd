#include "lab/study/scene_comparison.hpp"

#include "base/try.hpp"
#include "lab/study/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::lab {
namespace {

/// The points of a study of whole scenes: draws them, compares them with the first, and times them.
class SceneComparison {
public:
    SceneComparison(const Study& study, const Circumstances& circumstances) {
        findings_.set.study = study;
        findings_.set.study.series = {{"changed", Trust::unknown, {}, {}}};
        findings_.set.circumstances = circumstances;
        findings_.set.words.defaults = "the scene as it is";
        findings_.set.picture_standard = {
            "the scene as it is", 0.0,
            "none of its own: what is asked is how far a changed scene is from it"};
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

Result<Truth> truth_of(std::vector<image::Image> pictures) {
    Truth truth{std::move(pictures), {}, {}, {}};
    size_t blind = 0, pixels = 0;
    for (const image::Image& picture : truth.pictures) {
        PixelMask& mask = truth.blind.emplace_back();
        add_blind(picture, mask);
        blind += size_t(std::ranges::count(mask, true));
        pixels += mask.size();
    }
    if (const std::string why = too_blind(blind, pixels); !why.empty())
        return fail(ErrorCode::check_failed, "nothing can be held against the scene's picture: " + why);
    return truth;
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
