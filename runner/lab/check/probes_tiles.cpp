// Checks whether a picture drawn in tiles, as large ones are (render/tile_grid.hpp), equals one drawn whole.
#include "base/try.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/picture_gap.hpp"
#include "lab/check/probes.hpp"
#include "render/bands.hpp"

#include <fmt/format.h>

namespace tidemark::lab {
namespace {

/// Not divisible by the tile's size, so that tiles extend past both sides.
constexpr Extent k_odd{61, 37};
constexpr Extent k_tile{16, 8};
constexpr double k_same_to_the_eye = 50; ///< PSNR in dB above which differences are invisible

} // namespace

Result<Answer> ask_tiles(ProbeBench& bench) {
    const FrameState state = state_at(0, k_odd); // frame 0, so that no earlier frame is needed
    const render::FrameInputs inputs = inputs_of(state);
    const auto drawn = [&](std::optional<Extent> tile) {
        auto renderer = render::Renderer::create(
            bench.scene(), {.extent = k_odd, .samples = image::SampleType::f32, .tile = tile});
        if (renderer)
            renderer->draw(inputs);
        return renderer;
    };
    auto cut = TRY(drawn(k_tile));
    if (!cut.tiles())
        return Answer{Verdict::not_applicable, "a pass reads the picture, which is drawn whole at any size"};
    const image::Image tiled = render::draw_in_tiles(cut, inputs);
    const auto whole = TRY(drawn(std::nullopt));
    const image::Image uncut = whole.read_back();
    const size_t different = different_pixels(tiled, uncut);
    // Mesa 25 reads texture levels slightly differently in each tile.
    if (const auto gap = image::compare(uncut, tiled); different > 0 && gap && gap->psnr >= k_same_to_the_eye)
        return Answer{Verdict::pass,
                      fmt::format("{} of {} pixels differ in {} tiles, by less than shows: {:.0f} dB",
                                  different, tiled.extent.pixels(), cut.tiles()->count(), gap->psnr)};
    if (different > 0)
        return Answer{Verdict::fail,
                      fmt::format("{} of {} pixels differ when drawn in {}x{} tiles{}", different,
                                  tiled.extent.pixels(), k_tile.width, k_tile.height, bench.see_bounds()),
                      state, image::without_alpha(tiled)};
    return Answer{Verdict::pass, fmt::format("the same bytes in {} tiles", cut.tiles()->count())};
}

} // namespace tidemark::lab
