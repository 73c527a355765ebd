// Numbers of a text as uniforms: which settings one program shows.
#include "lab/specimen.hpp"
#include "support/scene_of.hpp"

#include <gmock/gmock.h>

namespace tidemark::lab::turnable_scene_test {

using testing::HasSubstr;
using testing::Not;

std::string text_of(const TurnableScene& turnable) {
    return turnable.scene().image().text.text();
}

/// The knobs' values at these settings, as GLSL writes them; empty where they are another program.
std::string turned_to(const TurnableScene& turnable, const std::vector<Setting>& settings) {
    std::string values;
    for (const scene::Knob& knob : turnable.knobs_at(settings).value_or(std::vector<scene::Knob>{}))
        values += to_string(knob) + ";";
    return values;
}

TEST(TurnableScene, literals_become_uniforms_of_their_type) {
    const std::vector<Setting> settings{{"N", "64"}, {"NEAR", "0.001"}, {"FAR", "50.0"}};
    const auto turnable = TurnableScene::create(scene_of("#define N 32\n"
                                                         "const float NEAR = 0.01, FAR = 50.0;\n"
                                                         "float f() { return FAR * NEAR * float(N); }\n"),
                                                settings);
    ASSERT_TRUE(turnable);
    EXPECT_THAT(text_of(*turnable), HasSubstr("#define N tidemark_setting_0\n"));
    EXPECT_THAT(text_of(*turnable), HasSubstr(" float NEAR = tidemark_setting_1, FAR = tidemark_setting_2;"));
    EXPECT_THAT(text_of(*turnable), Not(HasSubstr("const")));
    EXPECT_EQ(turnable->scene().knobs[0].type, scene::KnobType::int1);
    EXPECT_EQ(turnable->scene().knobs[1].type, scene::KnobType::float1);
    EXPECT_EQ(turned_to(*turnable, settings), "64;0.001;50;");
    EXPECT_EQ(turned_to(*turnable, {{"N", "128"}, {"NEAR", "5e-4"}, {"FAR", "50.0"}}), "128;0.0005;50;");
}

TEST(TurnableScene, unnamed_literals_and_knobs_become_uniforms) {
    const auto scene = scene_of("#iUniform float pace = 1.0 in { 0.0, 2.0 }\n"
                                "float f() { for (int i = 0; i < 80; i++) g(pace); }\n");
    const std::string place = scene.image().text.lines().locate(2).file + ":2:33";
    const auto turnable = TurnableScene::create(scene, {{place, "80"}, {"pace", "1.0"}});
    ASSERT_TRUE(turnable);
    EXPECT_THAT(text_of(*turnable), HasSubstr("i < tidemark_setting_0;"));
    EXPECT_EQ(turned_to(*turnable, {{place, "160"}, {"pace", "0.5"}}), "0.5;160;");
}

TEST(TurnableScene, values_used_by_the_preprocessor_need_another_program) {
    const std::string text = "#define N 3\n"
                             "#if N > 4\n"
                             "float f() { return 1.0; }\n"
                             "#else\n"
                             "float f() { return float(N); }\n"
                             "#endif\n";
    const auto turnable = TurnableScene::create(scene_of(text), {{"N", "3"}});
    ASSERT_TRUE(turnable);
    EXPECT_EQ(turned_to(*turnable, {{"N", "4"}}), "4;");
    EXPECT_EQ(turned_to(*turnable, {{"N", "5"}}), "");
}

TEST(TurnableScene, another_solver_or_number_type_needs_another_program) {
    const auto turnable = TurnableScene::create(scene_of("#define SOLVER a\n"
                                                         "#define N 3\n"
                                                         "float f() { return SOLVER(N); }\n"),
                                                {{"SOLVER", "b"}, {"N", "3"}});
    ASSERT_TRUE(turnable);
    EXPECT_EQ(turned_to(*turnable, {{"SOLVER", "b"}, {"N", "4"}}), "4;");
    EXPECT_EQ(turned_to(*turnable, {{"SOLVER", "a"}, {"N", "4"}}), "");
    EXPECT_EQ(turned_to(*turnable, {{"SOLVER", "b"}, {"N", "4.0"}}), "");
    EXPECT_EQ(turned_to(*turnable, {{"SOLVER", "b"}, {"N", "-4"}}), "");
    EXPECT_EQ(turned_to(*turnable, {{"SOLVER", "b"}}), "") << "the scene's own number is no uniform";
}

TEST(TurnableScene, unknown_names_are_errors) {
    EXPECT_FALSE(TurnableScene::create(scene_of("float f() { return 1.0; }\n"), {{"N", "3"}}));
}

} // namespace tidemark::lab::turnable_scene_test
