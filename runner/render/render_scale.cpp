#include "render/render_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::render {
namespace {

constexpr int k_smallest = -3;
constexpr int k_largest = 1;

} // namespace

std::vector<RenderScale> RenderScale::all() {
    std::vector<RenderScale> scales;
    for (int exponent = k_smallest; exponent <= k_largest; ++exponent)
        scales.push_back(RenderScale(exponent));
    return scales;
}

std::optional<RenderScale> RenderScale::named(std::string_view name) {
    const std::vector<RenderScale> scales = all();
    const auto found = std::ranges::find(scales, name, &RenderScale::name);
    return found == scales.end() ? std::nullopt : std::optional(*found);
}

std::string RenderScale::name() const {
    return exponent_ < 0 ? fmt::format("1/{}", 1 << -exponent_) : fmt::format("{}", 1 << exponent_);
}

Extent RenderScale::drawn(Extent window) const {
    const auto scaled = [this](int length) {
        return std::max(1, int(std::lround(std::ldexp(double(length), exponent_))));
    };
    return {scaled(window.width), scaled(window.height)};
}

RenderScale RenderScale::stepped(int steps) const {
    return RenderScale(std::clamp(exponent_ + steps, k_smallest, k_largest));
}

} // namespace tidemark::render
