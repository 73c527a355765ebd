#include "glsl_support.hpp"
#include "shader/survey.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::hit_test {

const std::string k_scene = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n"
                            "#ifdef TIDEMARK_HIT\n"
                            "void mainHit(out vec4 hit, in vec2 p) { hit = vec4(p, 0, 0); }\n"
                            "#endif\n";

TEST(Hit, the_hit_program_keeps_all_four_numbers_of_main_hit) {
    const auto scene = hit_scene(scene_of(k_scene));
    ASSERT_TRUE(scene);
    const ShaderSource source = assemble(*scene, scene->image());
    EXPECT_EQ(count(source.text(), "#define TIDEMARK_HIT 1\n"), 1);
    EXPECT_EQ(count(source.text(), "    mainHit(tidemark_color, tidemark_at);\n"), 1);
    EXPECT_EQ(count(source.text(), "mainImage(tidemark"), 0);
    EXPECT_EQ(source.lines().locate(line_of(source, "void mainHit(out vec4 hit, in vec2 p)")).line, 3);
}

TEST(Hit, the_picture_program_does_not_contain_main_hit) {
    const ShaderSource source = source_of(k_scene);
    EXPECT_EQ(count(source.text(), "#define TIDEMARK_HIT"), 0);
    EXPECT_EQ(count(source.text(), "mainHit(tidemark"), 0);
}

TEST(Hit, a_scene_without_main_hit_has_no_hit_scene) {
    EXPECT_FALSE(hit_scene(scene_of("// mainHit\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n")));
}

TEST(Hit, main_hit_may_be_in_common) {
    scene::Scene scene = scene_of("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    scene.common.append("void mainHit(out vec4 hit, in vec2 p) { hit = vec4(0); }\n", "common.glsl", 1);
    EXPECT_TRUE(hit_scene(scene));
}

} // namespace tidemark::glsl::hit_test
