#include "lab/device/sample_drawing.hpp"

#include "base/try.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

constexpr int k_row = 256;

// PCG's hash (O'Neill 2014) uses integers only, so it is the same everywhere.
constexpr std::string_view k_frame = R"(uint bits(uint n) {{
    n = n * 747796405u + 2891336453u;
    n = ((n >> ((n >> 28u) + 4u)) ^ n) * 277803737u;
    return (n >> 22u) ^ n;
}}
float spread(uint n, float a, float b) {{
    return a + (b - a) * (float(bits(n) >> 8u) / 16777216.0);
}}
void mainImage(out vec4 c, in vec2 p) {{
    uint i = uint(p.y) * {}u + uint(p.x);
    {}
}}
)";

double ulp_at(double number) {
    constexpr int k_least = std::numeric_limits<float>::min_exponent - 1;
    const int exponent = number == 0.0 ? k_least : std::max(std::ilogb(number), k_least);
    return std::ldexp(1.0, exponent - (std::numeric_limits<float>::digits - 1));
}

} // namespace

Result<render::Renderer> renderer_of(std::string_view text, const render::RenderOptions& options) {
    scene::Scene scene;
    scene.file = "self-test.glsl";
    scene.passes.resize(1);
    scene.passes[0].text.append(text, "self-test.glsl", 1);
    return render::Renderer::create(std::move(scene), options);
}

Result<std::vector<Sample>> samples_of(std::string_view statements, int count) {
    const Extent extent{k_row, (count + k_row - 1) / k_row};
    const std::string text = fmt::format(k_frame, k_row, statements);
    auto renderer = TRY(renderer_of(text, {.extent = extent, .samples = image::SampleType::f32}));
    renderer.draw({});
    const image::Image picture = renderer.read_back();
    std::vector<Sample> samples(extent.pixels());
    for (size_t i = 0; i < samples.size(); ++i)
        std::ranges::copy(picture.f32().subspan(4 * i, 3), samples[i].begin());
    return samples;
}

double ulps_between(double truth, float got) {
    if (float(truth) == got || (std::isnan(truth) && std::isnan(got)))
        return std::isfinite(got) ? std::abs(double(got) - truth) / ulp_at(truth) : 0.0;
    if (!std::isfinite(got) || !std::isfinite(truth))
        return std::numeric_limits<double>::infinity();
    return std::abs(double(got) - truth) / ulp_at(truth);
}

} // namespace tidemark::lab
