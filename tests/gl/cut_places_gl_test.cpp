// The cuts of a scene's texts, drawn: what a texture's level changes.
#include "gl_test.hpp"
#include "lab/simplify.hpp"
#include "support/scene_of.hpp"

#include <algorithm>
#include <cmath>

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

/// A march with a limit that has a name, an ambient loop, a texture, terms and factors.
const char* const k_many_cuts = R"(
const float k_near = 0.001;
#define STEPS 40
const int k_count = 4;
float weights[k_count];
float map(vec3 p) { return length(p) - 1.0 + 0.1 * sin(5.0 * p.x) * sin(5.0 * p.y) + 0.02 * sin(20.0 * p.z); }
void mainImage(out vec4 c, in vec2 p) {
    for (int i = 0; i < k_count; ++i)
        weights[i] = exp(-float(i)) * cos(iTime * sin(float(i)));
    vec3 d = normalize(vec3((2.0 * p - iResolution.xy) / iResolution.y, 1.5)), o = vec3(0.0, 0.0, -3.0);
    float t = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        float h = map(o + t * d);
        if (h < k_near || t > 10.0) break;
        t += h;
    }
    vec3 q = o + t * d;
    float dark = 0.0;
    for (int i = 1; i < 6; ++i)
        dark += weights[i % 4] * max(0.0, 0.1 * float(i) - map(q - 0.1 * float(i) * d));
    c = vec4(t > 10.0 ? d : 0.5 + 0.3 * sin(3.0 * q) - 0.2 * dark, 1.0) + 0.1 * texture(iChannel0, q.xy);
}
)";

TEST(CutSwitches, show_the_error_of_each_cut_alone) {
    const scene::Scene scene = scene_of(k_many_cuts);
    const auto keep_going = [] { return true; };
    const auto found = find_cuts(scene, default_views(), k_extent, keep_going);
    ASSERT_TRUE(found);
    auto bench = CutBench::create(scene, k_extent, default_views(), 0);
    ASSERT_TRUE(bench);
    std::vector<size_t> which;
    for (size_t i = 0; i < found->cuts.size(); ++i)
        if (!found->cuts[i].switched.empty())
            which.push_back(i);
    EXPECT_GT(which.size(), 40U);
    auto switches = CutSwitches::create(scene, k_extent, found->cuts, which, keep_going);
    ASSERT_TRUE(switches);
    EXPECT_GE(switches->which().size() + 2, which.size()) << "only the size of an array stays constant";
    ASSERT_TRUE(bench->take_as_reference(*switches, Goal{Measure::rmse, 1e-3, {}}));
    for (const size_t i : switches->which()) {
        const auto error = bench->error_of_switched(*switches, std::span(&i, 1), k_any_error);
        const auto trial = bench->try_cuts(std::span(&found->cuts[i].change, 1), bench->own(), k_any_error);
        ASSERT_TRUE(trial) << found->cuts[i].change.reason;
        ASSERT_TRUE(error) << found->cuts[i].change.reason;
        EXPECT_NEAR(*error, trial->error, 2e-3 + 0.02 * trial->error) << found->cuts[i].change.reason;
    }
}

TEST(CutSwitches, make_several_cuts_together_and_none_again) {
    const scene::Scene scene = scene_of("void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    c = vec4(0.0, 0.0, 0.0, 1.0);\n"
                                        "    c.x += 0.25 * exp(sin(0.0 * p.x));\n"
                                        "    c.y += 0.5 * exp(sin(0.0 * p.x));\n}\n");
    auto found = find_cuts(scene, default_views(), k_extent, [] { return true; });
    ASSERT_TRUE(found);
    std::erase_if(found->cuts, [](const glsl::Cut& cut) {
        return cut.change.reason.find("leaves out `c.") == std::string::npos;
    });
    ASSERT_EQ(found->cuts.size(), 2U);
    auto bench = CutBench::create(scene, k_extent, default_views(), 0);
    ASSERT_TRUE(bench);
    auto switches = CutSwitches::create(scene, k_extent, found->cuts, {0, 1}, [] { return true; });
    ASSERT_TRUE(switches);
    ASSERT_TRUE(bench->take_as_reference(*switches, k_any_error));
    const auto error = [&](std::vector<size_t> cuts) {
        return bench->error_of_switched(*switches, cuts, k_any_error).value_or(-1);
    };
    EXPECT_NEAR(error({0}) + error({1}), 0.75 / std::sqrt(3.0), 1e-4) << "RMSE over three channels";
    EXPECT_NEAR(error({0, 1}), std::sqrt((0.25 * 0.25 + 0.5 * 0.5) / 3), 1e-4);
    EXPECT_EQ(error({}), 0);
}

} // namespace tidemark::lab::cut_places_gl_test
