#include "lab/march/pixel_work.hpp"

#include "base/try.hpp"
#include "lab/march/pass_function.hpp"
#include "lab/march/pass_textures.hpp"
#include "lab/stopwatch.hpp"

#include <algorithm>

namespace tidemark::lab {
namespace {

constexpr int k_columns = 16, k_rows = 9;
constexpr double k_most_milliseconds = 1500;

/// Derivatives are not supported: they need the neighbouring pixels.
bool takes_derivatives(const ir::Function& function) {
    return std::ranges::any_of(function.instructions, [](const ir::Instruction& each) {
        return each.op == ir::Op::derivative_x || each.op == ir::Op::derivative_y;
    });
}

bool knows_all(const ir::Function& function, const ir::TextureSet& textures) {
    return std::ranges::all_of(function.lookups, [&](const ir::Lookup& lookup) {
        return lookup.form == ir::Lookup::Form::size || textures.contains(lookup.sampler);
    });
}

} // namespace

Result<PixelWork> count_work(const render::Renderer& renderer, size_t pass,
                             const render::FrameInputs& inputs) {
    const scene::Scene& scene = renderer.scene();
    if (scene.passes[pass].kind == scene::PassKind::cubemap)
        return fail(ErrorCode::load, "those of a cubemap pass are not followed");
    const auto function = TRY(PassFunction::create(scene, scene.passes[pass]));
    const ir::TextureSet textures = textures_of(renderer, pass);
    if (takes_derivatives(function.function()) || !knows_all(function.function(), textures))
        return fail(ErrorCode::load, "it takes derivatives, or reads what is not at hand");
    ir::FloatEvaluator start = function.frame(renderer, pass, inputs);
    start.textures = ir::textures_in<ir::Point<float>>(textures);
    const Extent extent = renderer.extent();
    const Stopwatch clock;
    PixelWork work;
    // Takes every seventh pixel of the grid, so that the pixels of a short run are spread over the picture.
    for (int i = 0; i < k_columns * k_rows && clock.elapsed().wall < k_most_milliseconds; ++i) {
        const int place = i * 7 % (k_columns * k_rows);
        ir::FloatEvaluator pixel = start;
        function.move_to(pixel, {(2 * (place % k_columns) + 1) * extent.width / (2 * k_columns),
                                 (2 * (place / k_columns) + 1) * extent.height / (2 * k_rows)});
        ir::Decisions decisions(0);
        pixel.run(decisions, [](uint32_t) { return true; });
        work.operations += double(pixel.steps());
        ++work.pixels;
    }
    work.operations /= double(std::max<size_t>(1, work.pixels));
    return work;
}

} // namespace tidemark::lab
