// Computes numbers on the device by drawing a text, one sample per pixel.
#pragma once

#include "base/result.hpp"
#include "render/renderer.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// Returns a renderer for a text with mainImage.
Result<render::Renderer> renderer_of(std::string_view text, const render::RenderOptions& options);

/// Red, green and blue of a pixel; an image's alpha is always 1.
using Sample = std::array<float, 3>;

/// Runs `statements` per sample and returns the results. They may use `uint i`, the sample's number, `uint
/// bits(uint)`, a hash, and `float spread(uint, a, b)`, a uniform number between a and b, and must assign
/// `c.rgb`. `count` is rounded up to whole rows of 256.
Result<std::vector<Sample>> samples_of(std::string_view statements, int count);

/// Returns the distance of two numbers in units in the last place of a float at `truth`.
double ulps_between(double truth, float got);

} // namespace tidemark::lab
