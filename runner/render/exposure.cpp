#include "render/exposure.hpp"

#include "base/error.hpp"
#include "media/image.hpp"

#include <algorithm>

namespace tidemark::render {
using image::Image;
namespace {

/// Mirrors the digits of a number at the point (J. G. van der Corput, 1935); in [0, 1).
double radical_inverse(int number, int base) {
    double inverse = 0;
    for (double digit = 1.0 / base; number > 0; number /= base, digit /= base)
        inverse += digit * (number % base);
    return inverse;
}

/// Returns the mean radical inverse of 0 to `count` - 1.
double mean_inverse(int count, int base) {
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += radical_inverse(i, base);
    return sum / count;
}

/// Returns false when it was stopped.
bool draw_band(Renderer& renderer, const Sample& sample, int number, const BeforeTile& before_tile,
               Image& band) {
    const TileGrid grid = *renderer.tiles();
    for (int column = 0; column < grid.columns(); ++column) {
        if (!before_tile())
            return false;
        renderer.draw_tile(sample.inputs, grid.at(column, number), band, {sample.x, sample.y});
    }
    return true;
}

} // namespace

ExposedFrame expose(const Exposure& exposure, const FrameState& state) {
    const int count = exposure.samples;
    const double middle_x = mean_inverse(count, 2), middle_y = mean_inverse(count, 3);
    ExposedFrame frame{{}, exposure.shutter > 0, exposure.clamped};
    FrameState moment = state;
    for (int i = 0; i < count; ++i) {
        if (frame.moving)
            moment.time = state.seconds() + exposure.shutter * (i + 0.5) / count / state.fps;
        frame.samples.push_back(
            {inputs_of(moment), radical_inverse(i, 2) - middle_x, radical_inverse(i, 3) - middle_y});
    }
    return frame;
}

Result<bool> draw_bands(Renderer& renderer, const ExposedFrame& frame, const BeforeTile& before_tile,
                        const TakeBand& take) {
    const TileGrid grid = *renderer.tiles();
    Image band;
    image::LightMean mean(frame.clamped);
    for (int number = 0; number < grid.bands(); ++number) {
        const Extent extent{renderer.extent().width, grid.at(0, number).extent.height};
        if (band.extent != extent)
            band = Image(extent, 4, renderer.samples());
        for (const Sample& sample : frame.samples) {
            if (frame.moving)
                renderer.draw(sample.inputs);
            if (!draw_band(renderer, sample, number, before_tile, band))
                return false;
            if (frame.samples.size() > 1)
                mean.add(band);
        }
        if (frame.samples.size() > 1)
            mean.take(band);
        band = TRY(take(std::move(band)));
    }
    return true;
}

std::optional<Image> draw_in_tiles(Renderer& renderer, const ExposedFrame& frame,
                                   const BeforeTile& before_tile) {
    Image whole(renderer.extent(), 4, renderer.samples());
    auto end = whole.bytes.end();
    const auto complete = draw_bands(renderer, frame, before_tile, [&](Image band) -> Result<Image> {
        end = std::ranges::copy_backward(band.bytes, end).out;
        return band;
    });
    return *complete ? std::optional(std::move(whole)) : std::nullopt;
}

Image draw_in_tiles(Renderer& renderer, const FrameInputs& inputs) {
    return *draw_in_tiles(renderer, {.samples = {{inputs}}}, [] { return true; });
}

} // namespace tidemark::render
