// --define: the value of a #define or a const, replaced.
#include "glsl_support.hpp"
#include "shader/definitions.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::overrides_test {

/// `text` with the setting carried out, or why it could not be.
std::string with(std::string_view setting, std::string_view text) {
    scene::Scene scene = scene_of(text);
    const auto done = override_definition(scene, setting);
    if (done)
        return scene.image().text.text();
    EXPECT_EQ(done.error().code, ErrorCode::usage);
    EXPECT_EQ(scene.image().text.text(), scene_of(text).image().text.text());
    return done.error().message;
}

TEST(OverrideDefine, replaces_the_value) {
    EXPECT_EQ(with("A=2", "#define A 1\n"), "#define A 2\n");
    EXPECT_EQ(with("A=2", "#define A 1 + (3 * 4) // why\n"), "#define A 2 // why\n");
    EXPECT_EQ(with("A=2", "  #  define  A  1  \n"), "  #  define  A  2  \n");
    EXPECT_EQ(with("A=2", "#define A (1)\n"), "#define A 2\n");
    EXPECT_EQ(with("A=2", "#define A /* old */ 1\n"), "#define A /* old */ 2\n");
}

TEST(OverrideDefine, adds_a_value_to_an_empty_define) {
    EXPECT_EQ(with("A=2", "#define A\nb"), "#define A 2\nb\n");
    EXPECT_EQ(with("A=2", "#define A // on\n"), "#define A 2 // on\n");
    EXPECT_EQ(with("A=2", "#define A"), "#define A 2\n");
}

TEST(OverrideDefine, an_empty_value_is_accepted) {
    EXPECT_EQ(with("A=", "#define A 1\n"), "#define A \n");
}

TEST(OverrideDefine, the_value_may_be_any_text) {
    EXPECT_EQ(with("A=x == y ? f(1, 2) : 3.", "#define A 1\n"), "#define A x == y ? f(1, 2) : 3.\n");
}

TEST(OverrideDefine, values_over_lines_move_no_line) {
    EXPECT_EQ(with("A=2", "#define A 1 + \\\n 3 + \\\n 4\nb\n"), "#define A 2\n\n\nb\n");
    EXPECT_EQ(with("A=2", "#define A \\\n 1\nb\n"), "#define A \\\n 2\nb\n");
    EXPECT_EQ(with("A=2", "#define A 1 /* a\n b */ + 3\nc\n"), "#define A 2\n\nc\n");
}

TEST(OverrideDefine, common_is_searched) {
    scene::Scene scene = scene_of("float x = PI;\n");
    scene.common.append("#define PI 3.14\n", "common.glsl", 1);
    ASSERT_TRUE(override_definition(scene, "PI=3"));
    EXPECT_EQ(scene.common.text(), "#define PI 3\n");
    EXPECT_EQ(definition_of(scene, "PI"), "3");
}

TEST(OverrideDefine, every_definition_is_replaced) {
    EXPECT_EQ(with("A=3", "#ifdef B\n#define A 1\n#else\n#define A 2\n#endif\n"),
              "#ifdef B\n#define A 3\n#else\n#define A 3\n#endif\n");
    EXPECT_EQ(with("A=3", "#define A 1\nconst int A = 2;\n"), "#define A 3\nconst int A = 3;\n");
}

TEST(OverrideDefine, in_every_pass) {
    scene::Scene scene = scene_of("#define A 1");
    scene.passes.push_back(scene_of("#define B 1").passes[0]);
    scene.passes.push_back(scene_of("#define A 2").passes[0]);
    ASSERT_TRUE(override_definition(scene, "A=3"));
    EXPECT_EQ(scene.passes[0].text.text(), "#define A 3\n");
    EXPECT_EQ(scene.passes[1].text.text(), "#define B 1\n");
    EXPECT_EQ(scene.passes[2].text.text(), "#define A 3\n");
}

TEST(OverrideDefine, macros_with_parameters_are_left_alone) {
    EXPECT_EQ(with("A=2", "#define A(x) x\n"), "the scene has no #define or const 'A': it defines none");
    EXPECT_EQ(with("A=2", "#define A() x\n#define A 1\n"), "#define A() x\n#define A 2\n");
}

TEST(OverrideDefine, comments_are_left_alone) {
    EXPECT_EQ(with("A=2", "// #define A 1\n/* #define A 1\n#define A 1 */\n#define A 1\n"),
              "// #define A 1\n/* #define A 1\n#define A 1 */\n#define A 2\n");
    EXPECT_EQ(with("A=2", "// #define A 1\n/* const int A = 1; */\n"),
              "the scene has no #define or const 'A': it defines none");
}

TEST(OverrideDefine, uses_and_other_directives_are_left_alone) {
    EXPECT_EQ(with("A=2", "#define A 1\n#if A == 1\n#undef A\n#endif\nint x = A;\n"),
              "#define A 2\n#if A == 1\n#undef A\n#endif\nint x = A;\n");
}

TEST(OverrideConst, replaces_the_value) {
    EXPECT_EQ(with("a=2", "const int a = 1;\n"), "const int a = 2;\n");
    EXPECT_EQ(with("a=2.", "const highp float a=1.*(3.-4.)  ;\n"), "const highp float a=2.  ;\n");
    EXPECT_EQ(with("v=vec3(0)", "const vec3 v = vec3(1, 2, 3);\n"), "const vec3 v = vec3(0);\n");
    EXPECT_EQ(with("m=mat2(0)", "const mat2 m = mat2(vec2(1, 2), vec2(3, 4));\n"),
              "const mat2 m = mat2(0);\n");
}

TEST(OverrideConst, replaces_each_of_several_declarators) {
    const std::string text = "const float a = f(1, 2), b = 3., c = 4.;\n";
    EXPECT_EQ(with("a=9.", text), "const float a = 9., b = 3., c = 4.;\n");
    EXPECT_EQ(with("b=9.", text), "const float a = f(1, 2), b = 9., c = 4.;\n");
    EXPECT_EQ(with("c=9.", text), "const float a = f(1, 2), b = 3., c = 9.;\n");
}

TEST(OverrideConst, inside_functions) {
    EXPECT_EQ(with("n=2", "void f(const int n, const in vec2 p) {\n    const int n = 1;\n}\n"),
              "void f(const int n, const in vec2 p) {\n    const int n = 2;\n}\n");
    EXPECT_EQ(with("n=2", "void f() { for (const int n = 1; n < 3;) {} }\n"),
              "void f() { for (const int n = 2; n < 3;) {} }\n");
}

TEST(OverrideConst, a_value_over_lines_moves_no_line) {
    EXPECT_EQ(with("a=2", "const int a =\n 1 +\n 3;\nb\n"), "const int a =\n 2\n;\nb\n");
}

TEST(OverrideConst, non_constants_are_unchanged) {
    for (const char* text :
         {"int a = 1;\n", "void f(const int a) {\n int b = 1; }\n", "const int b[2] = int[2](1, 2);"})
        EXPECT_EQ(with("a=2", text), "the scene has no #define or const 'a': it defines none") << text;
}

TEST(OverrideConst, an_unfinished_declaration_ends_at_the_next_declaration) {
    EXPECT_EQ(with("b=2", "const int a = (1\nconst int b = 3;\n"), "const int a = (1\nconst int b = 2;\n");
    EXPECT_EQ(with("B=2", "const int a = 1\n#define B 3\n"), "const int a = 1\n#define B 2\n");
}

TEST(OverrideDefinition, unknown_names_get_a_hint) {
    const std::string text = "#define OCTAVES 7\nconst float far = 1.;\n#define OCTAVES 8\n";
    EXPECT_EQ(with("OCTAVE=2", text), "the scene has no #define or const 'OCTAVE': did you mean 'OCTAVES'?");
    EXPECT_EQ(with("x=2", text), "the scene has no #define or const 'x': it has OCTAVES, far");
    EXPECT_EQ(with("x=2", "void f() {}"), "the scene has no #define or const 'x': it defines none");
}

TEST(OverrideDefinition, invalid_settings_are_refused) {
    EXPECT_EQ(with("A", "#define A 1"), "--define A: give it as NAME=VALUE");
    EXPECT_EQ(with("=1", "#define A 1"), "--define =1: give it as NAME=VALUE");
    EXPECT_EQ(with("A=1\n2", "#define A 1"), "--define A: the value must be one line");
    EXPECT_EQ(with("A=1\r2", "#define A 1"), "--define A: the value must be one line");
}

TEST(OverrideDefinition, junk_takes_linear_time) {
    for (const std::string piece : {"const ", "const a=(", "#define\n", "const a=1,"}) {
        std::string text;
        while (text.size() < 1'400'000)
            text += piece;
        text += "\n#define A 1";
        scene::Scene scene = scene_of(text);
        EXPECT_TRUE(override_definition(scene, "A=2")) << piece;
    }
}

TEST(DefinitionOf, follows_names_and_skips_inactive_code) {
    const scene::Scene scene =
        scene_of("#define FAST 0\n#if FAST\n#define STEPS 8\n#else\n#define STEPS MANY\n#endif\n"
                 "#define MANY 64\nconst float EPS = 1e-4, B = 2.0;\n#define ROUND round\n"
                 "#define round ROUND\n");
    EXPECT_EQ(definition_of(scene, "STEPS"), "64");
    EXPECT_EQ(definition_of(scene, "EPS"), "1e-4");
    EXPECT_EQ(definition_of(scene, "NONE"), std::nullopt);
    EXPECT_TRUE(definition_of(scene, "ROUND")); // round and round, and out
    EXPECT_EQ(definition_names(scene),
              (std::vector<std::string>{"FAST", "STEPS", "MANY", "EPS", "B", "ROUND", "round"}));
}

TEST(DefineByVariables, a_replaced_const_becomes_a_variable) {
    scene::Scene scene = scene_of("const int A = 1, B = 2; // why\n#define C\nconst int D = 3;\n");
    const scene::Setting variables[] = {{"B", "b"}, {"C", "c"}, {"A", "a"}, {"E", "e"}};
    define_by_variables(scene, variables);
    EXPECT_EQ(scene.image().text.text(), " int A = a, B = b; // why\n#define C c\nconst int D = 3;\n");
}

} // namespace tidemark::glsl::overrides_test
