#include "lab/check/marching_pass.hpp"

#include "base/try.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/spread.hpp"

#include <algorithm>

namespace tidemark::lab {
namespace {

constexpr Extent k_rays{16, 9};
/// Most field evaluations for all rays of a moment; a field with seven octaves takes some seconds for them.
constexpr uint64_t k_most_of_all = 50'000;

/// Returns the pixel of the i-th ray. The first rays are evenly spread over the picture, however many are
/// used.
glm::ivec2 pixel_of(size_t i, Extent whole) {
    const auto at = int(spread(i, k_rays.pixels()));
    const int x = at % k_rays.width, y = at / k_rays.width;
    return {(2 * x + 1) * whole.width / (2 * k_rays.width), (2 * y + 1) * whole.height / (2 * k_rays.height)};
}

} // namespace

void look_at_rays(Extent whole, const std::function<uint64_t(glm::ivec2 pixel)>& look) {
    uint64_t left = k_most_of_all;
    for (size_t i = 0; i < k_rays.pixels() && left > 0; ++i)
        left -= std::min<uint64_t>(left, look(pixel_of(i, whole)));
}

Result<std::optional<MarchingPass>> marching_pass(ProbeBench& bench) {
    std::vector<size_t> passes{bench.scene().image_index()};
    for (const render::PlannedPass& planned : TRY(bench.compiled())->plan().passes)
        passes.push_back(planned.pass);
    for (const size_t pass : passes) {
        const auto& function = bench.function_of(pass);
        if (function && !function->loops().empty())
            return MarchingPass{pass, &*function};
    }
    return std::nullopt;
}

Answer without_march(ProbeBench& bench) {
    const auto& image = bench.image_function();
    return {Verdict::not_applicable, image ? "no loop of a pass is found to march along a ray"
                                           : "the text cannot be followed: " + image.error().message};
}

Result<RayCounts> count_proved(ProbeBench& bench, const MarchingPass& pass) {
    const PassFunction& function = *pass.function;
    RayCounts counts;
    for (const double moment : k_ray_moments) {
        const FrameState state = state_at(moment);
        const render::Renderer& renderer = *TRY(bench.drawn(state));
        const ir::TextureSet textures = textures_of(renderer, pass.index);
        ir::FloatEvaluator pixel = function.frame(renderer, pass.index, render::inputs_of(state));
        look_at_rays(renderer.extent(), [&](glm::ivec2 at) -> uint64_t {
            function.move_to(pixel, at);
            const auto ray = prove_ray(function, pixel, textures, at, k_most_of_a_ray);
            if (!ray)
                return 0;
            counts.add(*ray);
            return ray->evaluations;
        });
    }
    return counts;
}

double wrong_percent(const RayCounts& counts) {
    const size_t wrong = counts.step_over + counts.miss;
    return wrong == 0 ? 0 : 100.0 * double(wrong) / double(counts.decided());
}

} // namespace tidemark::lab
