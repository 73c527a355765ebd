#include "lab/check/field_on_rays.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr Extent k_grid{16, 9};
constexpr double k_narrow = 1e-6;

double parameter(const ir::MarchSlice& slice, double units) {
    return slice.start() + units / slice.unit();
}

} // namespace

Result<FieldOnRays> FieldOnRays::create(ProbeBench& bench, const FrameState& state) {
    const auto& function = bench.image_function();
    if (!function)
        return fail(function.error());
    const render::Renderer& renderer = *TRY(bench.drawn(state));
    FieldOnRays field({*function, renderer, bench.scene().image_index(), inputs_of(state)});
    for (int y = 0; y < k_grid.height; ++y)
        for (int x = 0; x < k_grid.width; ++x) {
            const glm::ivec2 pixel{(2 * x + 1) * renderer.extent().width / (2 * k_grid.width),
                                   (2 * y + 1) * renderer.extent().height / (2 * k_grid.height)};
            auto ray = field.source_->enter(pixel, ir::Surface::zero);
            if (ray && ray->slice && !ray->march.turns.empty() && std::isfinite(ray->slice->start()))
                field.rays_.push_back(*std::move(ray));
        }
    return field;
}

std::optional<double> FieldOnRays::hit(size_t ray) const {
    const auto& [loop, march, slice, in_float] = rays_[ray];
    return march.hit ? std::optional((slice->parameter(march.turns.back()) - slice->start()) * slice->unit())
                     : std::nullopt;
}

double FieldOnRays::longest(size_t ray) const {
    double longest = 0;
    for (const ir::Turn& turn : rays_[ray].march.turns)
        if (std::isfinite(turn.distance()))
            longest = std::max(longest, std::abs(double(turn.distance())));
    return longest;
}

std::optional<double> FieldOnRays::in_float(size_t ray, double units) {
    return rays_[ray].in_float->distance(parameter(*rays_[ray].slice, units));
}

std::optional<double> FieldOnRays::exact(size_t ray, double units) {
    ir::MarchSlice& slice = *rays_[ray].slice;
    const auto found = slice.distance(ir::place_at(parameter(slice, units)), ir::Care::close);
    if (!found || found->partial)
        return std::nullopt;
    const double middle = found->low + found->width() / 2;
    return found->width() <= k_narrow * std::max(1.0, std::abs(middle)) ? std::optional(middle)
                                                                        : std::nullopt;
}

} // namespace tidemark::lab
