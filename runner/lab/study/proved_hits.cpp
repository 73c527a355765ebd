#include "base/try.hpp"
#include "lab/march/true_hits.hpp"
#include "lab/study/stricter.hpp"
#include "lab/study/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

ProvedHits none(std::string why) {
    return {.why_not = std::move(why)};
}

Standard standard_of(const PassFunction& function, const std::vector<Setting>& settings,
                     const std::vector<TrueHits>& views) {
    const SourceLocation where = function.locate(function.loops().front().line);
    Standard standard;
    standard.method = fmt::format(
        "{} the distance that {}:{} tests{}, proved from the text by interval "
        "arithmetic on every piece of a ray, in real arithmetic on rays set up in double",
        views.front().surface == ir::Surface::zero ? "first zeros of" : "first places below the threshold of",
        where.file, where.line, settings.empty() ? "" : fmt::format(" with {}", to_string(settings)));
    double squares = 0;
    size_t looked_at = 0, unknown = 0;
    for (const TrueHits& view : views) {
        squares += view.half_width * view.half_width * double(view.looked_at);
        looked_at += view.looked_at;
        unknown += view.unknown;
    }
    standard.uncertainty = std::sqrt(squares / double(std::max<size_t>(1, looked_at)));
    standard.check =
        fmt::format("{} of {} rays, evenly spread, each hit between two places; {} are not known", looked_at,
                    views.size() * views.front().hits.size(), unknown);
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
        return none("the text cannot be followed: " + function.error().message);
    if (function->loops().empty())
        return ProvedHits{{}, "no loop of Image is found to march along a ray", false};
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
            return none("interrupted");
        if (double(hits->unknown) > k_most_blind * double(hits->looked_at))
            return none(fmt::format("{} of {} rays are not decided by a proof from the text", hits->unknown,
                                    hits->looked_at));
        truth.views.push_back(hits->hits);
        truth.footprints.push_back(plain_footprint(study.extent));
        views.push_back(*std::move(hits));
    }
    truth.standard = standard_of(*function, settings, views);
    return ProvedHits{.truth = std::move(truth)};
}

} // namespace tidemark::lab
