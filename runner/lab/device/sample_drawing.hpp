// Numbers that a device computed: a text of our own is drawn, a sample each pixel.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// A text with mainImage.
Result<render::Renderer> renderer_of(std::string_view text, const render::RenderOptions& options);

/// Red, green and blue: the alpha of an image is 1.
using Sample = std::array<float, 3>;

/// `statements` see `uint i`, the number of the pixel, `uint bits(uint)`, a hash, and `float spread(uint, a,
/// b)`, numbers evenly between two; they assign `c.rgb`. `count` is rounded up to whole rows.
Result<std::vector<Sample>> samples_of(std::string_view statements, int count);

/// How far apart two numbers are, in units in the last place that floats have at `truth`.
double ulps_between(double truth, float got);

} // namespace tidemark::lab
