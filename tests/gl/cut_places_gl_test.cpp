// The cuts of a scene's texts, drawn: what a texture's level changes.
#include "gl_test.hpp"
#include "lab/simplify.hpp"
#include "support/scene_of.hpp"

#include <algorithm>

namespace tidemark::lab::cut_places_gl_test {

constexpr Extent k_extent{64, 36};
const Goal k_any_error{Measure::rmse, 1.0, {}};

/// Channel 0 reads noise with mipmaps, channel 1 without.
scene::Scene image_of(const std::string& body) {
    scene::Scene scene = scene_of(
        "void mainImage(out vec4 c, in vec2 p) {\n    vec2 uv = p / iResolution.xy;\n" + body + "\n}\n");
    scene.passes[0].channels[1].sampling.mipmaps = scene::Mipmaps::none;
    return scene;
}

std::vector<glsl::Cut> levels_of(const scene::Scene& scene) {
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    EXPECT_TRUE(found) << found.error().message;
    std::erase_if(found->cuts,
                  [](const glsl::Cut& cut) { return cut.change.reason.find("level") == std::string::npos; });
    std::ranges::sort(found->cuts, {}, [](const glsl::Cut& cut) { return cut.change.reason; });
    return found->cuts;
}

/// RMSE of each, by level.
std::vector<double> errors_of(const scene::Scene& scene) {
    auto bench = CutBench::create(scene, k_extent, default_views(), 1);
    EXPECT_TRUE(bench) << bench.error().message;
    std::vector<double> errors;
    for (const glsl::Cut& cut : levels_of(scene)) {
        const auto trial = bench->try_cuts(std::span(&cut.change, 1), bench->own(), k_any_error);
        EXPECT_TRUE(trial) << cut.change.reason;
        errors.push_back(trial ? trial->error : -1);
    }
    return errors;
}

TEST(CutPlaces, fixed_level_0_is_exact_for_magnification) {
    const auto errors = errors_of(image_of("c = texture(iChannel0, uv * 0.05);"));
    ASSERT_EQ(errors.size(), 4U);
    EXPECT_EQ(errors[0], 0) << "magnified: level 0 anyway";
    EXPECT_GT(errors[1], 0.001);
    EXPECT_LT(errors[1], errors[3]);
}

TEST(CutPlaces, a_coarser_level_is_nearer_where_texels_are_smaller_than_pixels) {
    const auto errors = errors_of(image_of("c = texture(iChannel0, uv * vec2(1.0, 0.5625));"));
    ASSERT_EQ(errors.size(), 4U);
    EXPECT_LT(errors[2], 0.001) << "4 texels a pixel";
    EXPECT_GT(errors[0], 10 * errors[2]);
}

TEST(CutPlaces, textures_without_mipmaps_have_no_level_cuts) {
    EXPECT_TRUE(levels_of(image_of("c = texture(iChannel1, uv);")).empty());
}

/// Rotations, a light and a knob's power, in functions that a march calls.
const char* const k_march = R"(
#define R(a) mat2(cos(a), sin(a), -sin(a), cos(a))
#define T (iTime * 0.7)
#iUniform float sharpness = 3.0 in { 1.0, 9.0 }
vec3 light() { return normalize(vec3(cos(iTime), 1.0, sin(iTime))); }
float map(vec3 p) {
    float wave = 0.5 + 0.5 * sin(T);
    p.xz *= R(T);
    p.xy *= R(-wave);
    return length(max(abs(p) - vec3(0.5, 0.3, wave), 0.0)) - 0.1 * pow(wave, sharpness);
}
void mainImage(out vec4 c, in vec2 p) {
    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 1.5)), o = vec3(0.0, 0.0, -3.0);
    float t = 0.0;
    for (int i = 0; i < 40; ++i)
        t += map(o + t * d);
    vec2 e = vec2(0.001, 0.0);
    vec3 q = o + t * d, n = vec3(map(q + e.xyy), map(q + e.yxy), map(q + e.yyx)) - map(q);
    c = vec4(t < 9.0 ? vec3(0.5 + 0.5 * dot(normalize(n), light())) : d, 1.0);
}
)";

TEST(CutPlaces, hoisted_expressions_keep_the_picture) {
    const scene::Scene scene = scene_of(k_march);
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    ASSERT_TRUE(found);
    std::erase_if(found->cuts, [](const glsl::Cut& cut) {
        return cut.change.reason.find("once per pixel") == std::string::npos;
    });
    ASSERT_EQ(found->cuts.size(), 1U);
    auto bench = CutBench::create(scene, k_extent, default_views(), 1);
    ASSERT_TRUE(bench);
    const auto trial = bench->try_cuts(std::span(&found->cuts[0].change, 1), bench->own(), k_any_error);
    ASSERT_TRUE(trial) << "the driver refuses it";
    EXPECT_LT(trial->error, 1e-3) << "drivers may round differently";
}

} // namespace tidemark::lab::cut_places_gl_test
