#include "glsl_support.hpp"
#include "shader/portability.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::portability_test {

std::string lint(const std::string& image, const std::string& common = {}) {
    scene::Scene scene = scene_of(image);
    scene.common.append(common, "common.glsl", 1);
    std::string words;
    for (const Diagnostic& diagnostic : portability_lint(scene))
        words += to_string(diagnostic) + "\n";
    return words;
}

TEST(Portability, portable_texts_give_no_warning) {
    for (const char* text :
         {"void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 0.5 + 0.5 * sin(iTime), "
          "1.0f); }\n",
          "float a = 1., b = -2.0; int i = 1; uint u = 3u; vec2 v = vec2(1);\n",
          "float f(float x) { return x; }\nvoid g() { float y = f(1.0), z = float(3); int n = 7 % 3; }\n",
          "// double filter; texture2D\n/* #version 450 */\n",
          "#if 0\ndouble d = 1.0lf;\n#version 450\n#endif\n",
          "struct S { float filter_; };\nfloat x = 1.0; float h() { S s; return s.filter_; }\n",
          "#define texture2D texture\nvec4 c(vec2 p) { return texture2D(iChannel0, p); }\n",
          "#define half float\nhalf x = 1.0;\n",
          "#define time iTime\nfloat now() { float t = time; return t; }\n",
          "float fma(float a, float b, float c) { return a * b + c; }\nfloat q() { return fma(1., 2., 3.); "
          "}\n",
          "const float k = 1.0; const int n = 3; float m = k * 2.0;\n", "int count = 3; float t[3];\n",
          "for_all(); mat2 r = mat2(1, 0, 0, 1);\n"})
        EXPECT_EQ(lint(text), "") << text;
}

TEST(Portability, characters_outside_glsl) {
    EXPECT_EQ(lint("float f = 1.0; // é is at home here\nvec4 g = vec4(\u201c1\u201d);\n"),
              "a.glsl:2:15: warning: '\u201c' (U+201C) is not a character of GLSL: names have letters a to z "
              "and A to Z, digits and _\n"
              "a.glsl:2:19: warning: '\u201d' (U+201D) is not a character of GLSL: names have letters a to z "
              "and A to Z, digits and _\n");
}

TEST(Portability, statements_outside_functions) {
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }";
    EXPECT_EQ(lint(image + ";\n"),
              "a.glsl:1:57: warning: ; alone: GLSL ES 3.00 does not allow it outside functions; remove it\n");
    EXPECT_EQ(lint("struct S { float a; };\nconst float b[2] = float[](1., 2.);\n" + image + "\n"), "");
    EXPECT_EQ(lint("uniform vec3 iResolution;\n" + image + "\n"),
              "a.glsl:1:14: warning: iResolution: the site declares it already; remove this\n");
    EXPECT_EQ(lint("float f(float iTime) { float iDate = iTime; return iDate; }\n" + image + "\n"), "");
    EXPECT_EQ(lint("float iCh0 = 1.0;\n" + image + "\n"),
              "a.glsl:1:7: warning: iCh0: the site declares it already; remove this\n");
    for (const char* second : {"out vec4 second;\n", "layout(location = 1) out vec4 second;\n"})
        EXPECT_NE(lint(second + image + "\n")
                      .find("out: the site declares the output itself and allows no second one"),
                  std::string::npos);
    EXPECT_EQ(lint("#define Main void mainImage(out vec4 Q, in vec2 U) { Q = vec4(0);\nMain\n  float i = "
                   "float(iFrame);\n  Q.r = i;\n}\n"),
              "");
}

TEST(Portability, main_image_must_match_the_sites_prototype) {
    const auto said = [](const std::string& head) { return lint(head + " { c = vec4(1.0); }\n"); };
    for (const char* good :
         {"void mainImage(out vec4 c, in vec2 p)", "void mainImage(out vec4 c, vec2 p)",
          "void mainImage(out highp vec4 c, vec2)", "#define V vec2\nvoid mainImage(out vec4 c, V p)"})
        EXPECT_EQ(said(good), "") << good;
    for (const char* bad :
         {"vec4 mainImage(out vec4 c, in vec2 p)", "void mainImage(inout vec4 c, in vec2 p)",
          "void mainImage(out vec4 c, const in vec2 p)"})
        EXPECT_NE(said(bad).find(
                      "mainImage: the site declares void mainImage(out vec4 fragColor, in vec2 fragCoord)"),
                  std::string::npos)
            << bad;
}

TEST(Portability, functions_that_a_macro_calls) {
    EXPECT_EQ(lint("#define KEY(i) texture2D(iChannel0, vec2(i, 0.5)).x\nvoid f() { float a = KEY(1.0); }\n"),
              "a.glsl:1:16: warning: texture2D: not in GLSL ES 3.00; write texture\n");
    EXPECT_EQ(lint("#define KEY(i) texture2D(iChannel0, vec2(i, 0.5)).x\nvoid f() { }\n"), "")
        << "nobody calls it";
}

TEST(Portability, names_and_values_that_the_site_refuses) {
    EXPECT_EQ(lint("void f() { float a__b = 1.0; a__b += 1.0; }\n"),
              "a.glsl:1:18: warning: a__b: names that contain two underscores in a row or begin with webgl_ "
              "are reserved on the site\n");
    EXPECT_EQ(lint("#define A__B 1.0\nvoid f() { float a = A__B; int v = __VERSION__; }\n"), "");
    EXPECT_EQ(
        lint("float h() { return 1.0; }\nvoid f() { h() = 2.0; }\n"),
        "a.glsl:2:16: warning: a value is assigned to a function's result: GLSL ES 3.00 refuses that\n");
    EXPECT_EQ(
        lint(
            "void f() { float a; (a) = 2.0; for (int i = 0; i < 3; ++i) a = 1.0; if (a == 1.0) a = 2.0; }\n"),
        "");
    EXPECT_EQ(lint("void f(vec2 p) { textureOffset(iChannel0, p, ivec2(9, -8)); textureOffset(iChannel0, p, "
                   "ivec2(-9, 7)); }\n"),
              "a.glsl:1:52: warning: 9: offsets go from -8 to 7 on the site\n"
              "a.glsl:1:96: warning: -9: offsets go from -8 to 7 on the site\n");
    EXPECT_EQ(
        lint("mat4 mix(mat4 a, mat4 b, float t) { return a; }\nfloat texture(vec2 p) { return p.x; }\n"), "");
}

TEST(Portability, words_that_the_site_reserves) {
    EXPECT_EQ(lint("float f(vec2 input) {\n  float filter = input.x; return filter; }\n"),
              "a.glsl:1:14: warning: input: a reserved word in GLSL ES 3.00; choose another name\n"
              "a.glsl:2:9: warning: filter: a reserved word in GLSL ES 3.00; choose another name\n");
    EXPECT_EQ(lint("static float x;\n"),
              "a.glsl:1:1: warning: static: a reserved word in GLSL ES 3.00; choose another name\n");
}

TEST(Portability, implicit_conversions) {
    EXPECT_EQ(lint("float x = 1;\n"),
              "a.glsl:1:11: warning: float x = 1: GLSL ES does not convert int implicitly; write 1.0\n");
    EXPECT_EQ(lint("vec2 v = -2, w;\n"),
              "a.glsl:1:11: warning: vec2 v = -2: GLSL ES does not convert int implicitly; write -vec2(2)\n");
}

TEST(Portability, desktop_features_missing_on_the_site) {
    EXPECT_EQ(lint("void f() { double d = 1.5lf; }\n"),
              "a.glsl:1:12: warning: double: GLSL ES has no double precision; write float\n"
              "a.glsl:1:23: warning: 1.5lf: GLSL ES has no double precision; write 1.5\n");
    EXPECT_EQ(lint("#define D dvec3\n"),
              "a.glsl:1:11: warning: dvec3: GLSL ES has no double precision; write vec3\n");
    EXPECT_EQ(lint("vec4 f(vec2 p) { return textureGather(iChannel0, p); }\n"),
              "a.glsl:1:25: warning: textureGather: not in GLSL ES 3.00; write four texelFetch\n");
    EXPECT_EQ(lint("float f(vec2 p) { return noise1(p); }\n"),
              "a.glsl:1:26: warning: noise1: not in GLSL ES 3.00; write a function of your own\n");
    EXPECT_EQ(
        lint("bool f() { return isKeyDown(65); }\n"),
        "a.glsl:1:19: warning: isKeyDown: not in GLSL ES 3.00; write texelFetch(iChannel0, ivec2(key, 0), "
        "0).x\n");
    EXPECT_EQ(lint("const float t[2] = { 1.0, 2.0 };\nconst float u[2] = float[](1.0, 2.0);\n"),
              "a.glsl:1:20: warning: = {: GLSL ES 3.00 has no initialiser lists; write a constructor, as in "
              "float[](1.0, 2.0)\n");
    EXPECT_EQ(lint("float mod(int a, int b) { return float(a % b); }\n"),
              "a.glsl:1:7: warning: mod: GLSL ES 3.00 forbids redefining a built-in function; choose another "
              "name\n");
}

TEST(Portability, lines_that_the_site_adds) {
    EXPECT_EQ(lint("#version 330\n"),
              "a.glsl:1:1: warning: #version: the site adds that line itself; remove it\n");
    EXPECT_EQ(lint("\n#extension GL_ARB_gpu_shader5 : enable\n"),
              "a.glsl:2:1: warning: #extension GL_ARB_gpu_shader5: the site enables the extensions of WebGL "
              "2 itself; remove this line\n");
}

TEST(Portability, values_outside_functions) {
    EXPECT_EQ(lint("float t = iTime * 2.0;\n"),
              "a.glsl:1:11: warning: iTime: outside functions GLSL ES allows only constant values; set t in "
              "mainImage, or make it a #define\n");
}

TEST(Portability, common_is_compiled_alone) {
    EXPECT_EQ(lint("", "float f() { return iTime; }\n"),
              "common.glsl:1:20: warning: iTime: the site compiles Common alone, where this is not declared; "
              "pass it as a parameter, or use a macro\n");
    for (const char* common : {"#define T iTime\n", "float f(float iTime) { return iTime; }\n",
                               "float f() { return iSampleRate + iDate.w; }\n"})
        EXPECT_EQ(lint("", common), "") << common;
}

} // namespace tidemark::glsl::portability_test
