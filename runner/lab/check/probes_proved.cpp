// What is proved of a scene's rays from its text alone, without a mainHit.
#include "base/try.hpp"
#include "lab/check/probes.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/march/proved_hits.hpp"
#include "lab/spread.hpp"
#include "lab/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

constexpr Extent k_rays{16, 9};
constexpr double k_moments[] = {1.0 / 3, 10};
constexpr uint64_t k_most_evaluations = 5'000; ///< of a ray
/// Of all rays: some seconds of a field of seven octaves. What is left of the rays is not looked at.
constexpr uint64_t k_most_of_all = 25'000;
/// Of the decided rays; below that is a matter of silhouettes.
constexpr double k_most_wrong_percent = 0.5;

double percent(size_t part, size_t all) {
    return all == 0 ? 0 : 100.0 * double(part) / double(all);
}

Answer none(std::string why) {
    return {Verdict::not_applicable, std::move(why)};
}

/// The i-th of the rays, evenly spread over the picture however many are taken.
glm::ivec2 pixel_of(size_t i, Extent whole) {
    const auto at = int(spread(i, k_rays.pixels()));
    const int x = at % k_rays.width, y = at / k_rays.width;
    return {(2 * x + 1) * whole.width / (2 * k_rays.width), (2 * y + 1) * whole.height / (2 * k_rays.height)};
}

Result<RayCounts> count(ProbeBench& bench, const PassFunction& function) {
    const size_t image = bench.scene().image_index();
    RayCounts counts;
    uint64_t left = k_most_of_all;
    for (const double moment : k_moments) {
        const FrameState state = state_at(moment);
        const render::Renderer& renderer = *TRY(bench.drawn(state));
        const ir::TextureSet textures = textures_of(renderer, image);
        ir::FloatEvaluator pixel = function.frame(renderer, image, render::inputs_of(state));
        const uint64_t least_left = moment == k_moments[0] ? left / 2 : 0;
        for (size_t i = 0; i < k_rays.pixels() && left > least_left; ++i) {
            const glm::ivec2 at = pixel_of(i, renderer.extent());
            function.move_to(pixel, at);
            if (const auto ray = prove_ray(function, pixel, textures, at, k_most_evaluations)) {
                counts.add(*ray);
                left -= std::min(left, ray->evaluations);
            }
        }
    }
    return counts;
}

std::string sentence_of(const PassFunction& function, const RayCounts& counts) {
    std::string text = fmt::format(
        "{:.3g} % of {} rays are decided: {:.3g} % of these step over their first hit, {:.3g} % miss it",
        percent(counts.decided(), counts.rays), counts.rays, percent(counts.step_over, counts.decided()),
        percent(counts.miss, counts.decided()));
    if (counts.undecided > 0)
        text += fmt::format("; of {:.3g} % it is not known ({})", percent(counts.undecided, counts.rays),
                            to_string(counts.commonest()));
    if (counts.at_base_level > 0)
        text += "; textures without a level are read at their base level";
    if (counts.wrong_loop) {
        const SourceLocation where = function.locate(function.loops()[*counts.wrong_loop].line);
        text += fmt::format("; {}:{} tests the distance: {} there", where.file, where.line,
                            counts.step_over > 0 ? "take shorter steps" : "take more steps");
    }
    return text;
}

} // namespace

Result<Answer> ask_first_hit(ProbeBench& bench) {
    const auto& function = bench.image_function();
    if (!function)
        return none("the text cannot be followed: " + function.error().message);
    if (function->loops().empty())
        return none("no loop of Image is found to march along a ray");
    const RayCounts counts = TRY(count(bench, *function));
    if (counts.rays == 0)
        return none("no ray comes to the loop that marches");
    if (counts.unknown_texture == counts.rays)
        return none("the march reads the frame before, which is gone, or a texture that is too large");
    if (counts.unfaithful == counts.rays)
        return none("the march remembers more than its place on the ray");
    if (counts.decided() == 0)
        return none(fmt::format("no ray is decided: {}", to_string(counts.commonest())));
    if (counts.contradicted > 0)
        return none(
            fmt::format("{} rays contradict their proof: please report this scene", counts.contradicted));
    const bool wrong = percent(counts.step_over + counts.miss, counts.decided()) > k_most_wrong_percent;
    return Answer{wrong ? Verdict::warn : Verdict::pass, sentence_of(*function, counts)};
}

} // namespace tidemark::lab
