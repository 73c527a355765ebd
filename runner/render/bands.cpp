#include "render/bands.hpp"

#include "base/try.hpp"

#include <algorithm>

namespace tidemark::render {

using image::Image;

Result<bool> draw_bands(const Renderer& renderer, const FrameInputs& inputs, const BeforeTile& before_tile,
                        const TakeBand& take) {
    const TileGrid grid = *renderer.tiles();
    Image band;
    for (int number = 0; number < grid.bands(); ++number) {
        const Extent extent{renderer.extent().width, grid.at(0, number).extent.height};
        if (band.extent != extent)
            band = Image(extent, 4, renderer.samples());
        for (int column = 0; column < grid.columns(); ++column) {
            if (!before_tile())
                return false;
            renderer.draw_tile(inputs, grid.at(column, number), band);
        }
        band = TRY(take(std::move(band)));
    }
    return true;
}

Image draw_in_tiles(const Renderer& renderer, const FrameInputs& inputs) {
    Image whole(renderer.extent(), 4, renderer.samples());
    auto end = whole.bytes.end();
    const auto always = [] { return true; };
    (void)draw_bands(renderer, inputs, always, [&](Image band) -> Result<Image> {
        end = std::ranges::copy_backward(band.bytes, end).out;
        return band;
    });
    return whole;
}

} // namespace tidemark::render
