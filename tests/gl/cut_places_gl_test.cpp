// The cuts of a scene's texts, drawn: what a texture's level changes.
#include "gl_test.hpp"
#include "lab/simplify/cut_places.hpp"
#include "lab/simplify/cut_trial.hpp"
#include "support/scene_of.hpp"

#include <algorithm>

namespace tidemark::lab {
namespace {

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
    auto bench = CutBench::create(scene, k_extent, default_views());
    EXPECT_TRUE(bench) << bench.error().message;
    std::vector<double> errors;
    for (const glsl::Cut& cut : levels_of(scene)) {
        const auto trial = bench->try_cuts(std::span(&cut.change, 1), bench->own(), k_any_error);
        EXPECT_TRUE(trial) << cut.change.reason;
        errors.push_back(trial ? trial->error : -1);
    }
    return errors;
}

TEST(CutPlaces, a_level_is_what_the_device_takes_where_it_would_be_that) {
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

TEST(CutPlaces, without_mipmaps_there_is_no_level_to_take) {
    EXPECT_TRUE(levels_of(image_of("c = texture(iChannel1, uv);")).empty());
}

} // namespace
} // namespace tidemark::lab
