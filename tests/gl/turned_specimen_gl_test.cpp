// One program turned from setting to setting shows what each of them shows when it is compiled by itself.
#include "lab/specimen.hpp"
#include "support/largest_difference.hpp"
#include "waters.hpp"

#include <set>

namespace tidemark::lab::turned_specimen_gl_test {

using glsl::Precision;

class TurnedSpecimenTest : public render::Waters {
protected:
    static scene::Scene ocean() {
        auto scene = scene::load_scene(render::k_shaders / "procedural_ocean.glsl");
        EXPECT_TRUE(scene) << to_string(scene.error());
        return *std::move(scene);
    }

    /// Whether one program showed them all.
    bool check(const scene::Scene& scene, const std::vector<std::vector<Setting>>& all, Precision precision) {
        const View view = default_views().front();
        TurnedSpecimen turned(scene, render::k_small, HitSource::main_hit);
        std::set<double> compilations; // by the time they took
        image::Image before;
        for (const auto& settings : all) {
            const auto specimen = turned.at(settings, precision);
            auto compiled = Specimen::create(scene, {settings, precision}, render::k_small);
            EXPECT_TRUE(specimen && compiled) << to_string(settings);
            if (!specimen || !compiled)
                return false;
            compilations.insert((*specimen)->compile_milliseconds());
            image::Image picture = (*specimen)->picture(view);
            EXPECT_LT(largest_difference(picture, compiled->picture(view)), 1e-6) << to_string(settings);
            EXPECT_TRUE(before.extent.pixels() == 0 || largest_difference(picture, before) > 0.01)
                << to_string(settings) << " shows the same as before: this tests nothing";
            const auto hits = (*specimen)->hits(view), wanted = compiled->hits(view);
            EXPECT_TRUE(hits && wanted && hits->distance == wanted->distance &&
                        hits->evaluations == wanted->evaluations)
                << to_string(settings);
            before = std::move(picture);
        }
        return compilations.size() == 1;
    }
};

TEST_F(TurnedSpecimenTest, numbers_change_without_recompiling) {
    EXPECT_TRUE(check(ocean(),
                      {{{"OCTAVES", "1"}, {"MAX_STEPS", "64"}},
                       {{"OCTAVES", "3"}, {"MAX_STEPS", "512"}},
                       {{"OCTAVES", "1"}, {"MAX_STEPS", "64"}}},
                      Precision::promoted));
}

/// FINE_OCTAVES is the size of arrays.
TEST_F(TurnedSpecimenTest, changed_constants_are_recompiled) {
    EXPECT_FALSE(check(ocean(), {{{"FINE_OCTAVES", "2"}}, {{"FINE_OCTAVES", "5"}}}, Precision::promoted));
}

TEST_F(TurnedSpecimenTest, each_precision_has_its_own_program) {
    const scene::Scene scene = scene_of("#define N 3\n"
                                        "void mainImage(out vec4 c, in vec2 p) {\n"
                                        "    float v = 1.0;\n"
                                        "    for (int i = 0; i < N; ++i) v += exp2(-30.0);\n"
                                        "    c = vec4((v - 1.0) * exp2(30.0));\n"
                                        "}\n");
    TurnedSpecimen turned(scene, {1, 1}, HitSource::none);
    const View view = default_views().front();
    for (const auto& [precision, seen] : {std::pair(Precision::single, 0.0F), {Precision::promoted, 4.0F}}) {
        const auto specimen = turned.at({{"N", "4"}}, precision);
        ASSERT_TRUE(specimen) << to_string(specimen.error());
        EXPECT_EQ((*specimen)->picture(view).f32()[0], seen);
    }
}

} // namespace tidemark::lab::turned_specimen_gl_test
