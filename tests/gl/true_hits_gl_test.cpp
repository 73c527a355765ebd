// Compares proofs about rays, made from a scene's own text, with the references that were written for the
// waters. The two share nothing but the scene.
#include "fields/certified_march.hpp"
#include "lab/march_hits.hpp"
#include "waters.hpp"

#include <cmath>

namespace tidemark::render::true_hits_gl_test {

constexpr Extent k_few{24, 14};

TEST_F(Waters, ProvedFirstHitsAgreeWithTheReferences) {
    for (const Water& water : k_waters) {
        auto loaded = scene::load_scene(k_shaders / (std::string(water.scene) + ".glsl"));
        ASSERT_TRUE(loaded) << to_string(loaded.error());
        scene::Scene scene = *std::move(loaded);
        define(scene, "SOLVER=MARCH_SPHERE");
        define(scene, "MAX_STEPS=1024");
        Renderer drawing = renderer(scene, k_few);
        const FrameInputs inputs = at(10, 15, 6);
        drawing.draw(inputs);
        const auto function = lab::PassFunction::create(scene, scene.passes[0]);
        ASSERT_TRUE(function) << function.error().message;
        const auto proved = lab::true_hits({*function, drawing, 0, inputs}, 1e6, [] { return true; });
        ASSERT_TRUE(proved);
        EXPECT_EQ(proved->looked_at, k_few.pixels());
        EXPECT_EQ(proved->unknown, 0u) << water.scene;
        EXPECT_LT(proved->half_width, 1e-6);
        const fields::Reference truth = reference(scene, water, inputs, k_few);
        size_t hits = 0, others = 0;
        for (size_t i = 0; i < k_few.pixels(); ++i) {
            const size_t row = i / k_few.width;
            const glm::dvec2 place(double(i % k_few.width) + 0.5, double(row) + 0.5);
            const double written =
                fields::certified_march(truth.field, truth.ray(place), truth.range).distance;
            const double found = proved->hits.distance[i];
            hits += written >= 0;
            others += std::abs(written - found) > 1e-5 * std::max(1.0, std::abs(written));
        }
        EXPECT_GT(hits, k_few.pixels() / 3) << water.scene;
        EXPECT_LE(others, k_few.pixels() / 200) << water.scene; // rays that graze a crest to a rounding
    }
}

/// A ball in the middle of the picture, marched with that start and that limit.
std::string ball(const std::string& start, const std::string& limit) {
    return "float map(vec3 p) { return length(p) - 1.0; }\n"
           "void mainImage(out vec4 c, in vec2 p) {\n"
           "    vec3 rd = normalize(vec3((p - 0.5 * iResolution.xy) / iResolution.y, 1.0));\n"
           "    float t = " +
           start +
           ";\n"
           "    for (int i = 0; i < 64; ++i) {\n"
           "        float d = map(vec3(0.0, 0.0, -3.0) + rd * t);\n"
           "        if (d < 0.001 || t > " +
           limit +
           ") break;\n"
           "        t += d;\n"
           "    }\n"
           "    c = vec4(exp(-t));\n"
           "}\n";
}

/// The proof about each ray.
struct Known {
    size_t hits = 0, misses = 0, unknown = 0;
};

class BallHits : public RenderTest {
protected:
    Known known(const std::string& text) const {
        const scene::Scene scene = scene_of(text);
        Renderer drawing = renderer(scene, k_few);
        drawing.draw({});
        const auto function = lab::PassFunction::create(scene, scene.passes[0]);
        EXPECT_TRUE(function) << function.error().message;
        const auto proved = lab::true_hits({*function, drawing, 0, {}}, 1e6, [] { return true; });
        EXPECT_TRUE(proved);
        if (!proved)
            return {};
        Known known{.unknown = proved->unknown};
        for (const double distance : proved->hits.distance) {
            known.hits += distance >= 0;
            known.misses += distance == -1;
        }
        return known;
    }
};

TEST_F(BallHits, WithoutALimitNoRayIsProvedToMiss) {
    const Known limited = known(ball("0.0", "20.0"));
    EXPECT_GT(limited.hits, k_few.pixels() / 20);
    EXPECT_GT(limited.misses, k_few.pixels() / 2);
    const Known infinite = known(ball("0.0", "1.0 / iTime"));
    EXPECT_EQ(infinite.hits, limited.hits);
    EXPECT_EQ(infinite.misses, 0u);
}

TEST_F(BallHits, RaysWithANonFiniteStartAreUndecided) {
    for (const char* start : {"0.0 / iTime", "1.0 / iTime", "-1.0 / iTime"}) {
        const Known nowhere = known(ball(start, "20.0"));
        EXPECT_EQ(nowhere.hits + nowhere.misses, 0u) << start;
        EXPECT_EQ(nowhere.unknown, k_few.pixels()) << start;
    }
}

} // namespace tidemark::render::true_hits_gl_test
