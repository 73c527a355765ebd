#include "glsl_support.hpp"
#include "shader/rewrite.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::rewrite_test {

/// The author's part of what the driver gets.
std::string rewritten(const std::string& text, const Dialect& dialect = {},
                      scene::PassKind kind = scene::PassKind::image) {
    text::MappedText mapped;
    mapped.append(text, "a.glsl", 1);
    const auto tokens = text::tokenize(mapped.text());
    const Preprocessed preprocessed = preprocess(tokens);
    const Survey facts = survey(tokens, preprocessed, kind);
    mapped.apply(rewrite(mapped.text(), tokens, preprocessed, facts, dialect).edits);
    return mapped.text();
}

TEST(Rewrite, a_valid_text_is_unchanged) {
    for (const char* text :
         {"void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 0, 1); }\n",
          "void mainImage(out vec4 o, in vec2 p) { vec2 q = p; if (q.x > 1.) { q = -q; } o = vec4(q, 0, 1); "
          "}\n",
          "struct S { float a, b; };\nuniform float mine;\nconst float c = 1.;\nfloat f(float x, vec2 y);\n",
          "float a[3];\nfloat[2] b;\nint x = 1, y = 2;\nS s;\nuniform B { vec4 c; };\n",
          "#define D float a, b\n#define E(n) float n;\n", "precision highp float;\nin vec2 v;\n"})
        EXPECT_EQ(rewritten(text), text);
}

TEST(Rewrite, version_and_extension_directives_are_blanked) {
    EXPECT_EQ(rewritten("#version 300 es\n#line 3\n#extension GL_OES_x : enable\n#pragma p\n"),
              "\n\n\n#pragma p\n");
    const std::string text =
        "float a = 1.;\n#extension GL_ARB_x : require\n#if 0\n#extension GL_ARB_y : enable\n#endif\n";
    const std::string source = source_of(text + "void mainImage(out vec4 o, vec2 p) { o = vec4(1); }").text();
    EXPECT_EQ(count(source, "#extension GL_ARB_x : enable\n"), 1);
    EXPECT_LT(source.find("#extension GL_ARB_x"), source.find("uniform"));
    EXPECT_GT(source.find("#extension GL_ARB_y"), source.find("uniform"));
}

TEST(Rewrite, parts_ignored_by_the_site_are_blanked) {
    EXPECT_EQ(rewritten("#pragma optimize(off);\n"), "#pragma optimize(off) \n");
    EXPECT_EQ(rewritten("#if 0\nfloat a;\n#elseif b\nfloat c;\n#endif\n"),
              "#if 0\nfloat a;\n\nfloat c;\n#endif\n");
    EXPECT_EQ(rewritten("#if 1\n#elseif b\n#endif\n"), "#if 1\n#elseif b\n#endif\n")
        << "an error on the site";
}

TEST(Rewrite, names_reserved_by_the_driver_are_renamed) {
    EXPECT_EQ(rewritten("float packed = sample;\n"), "float st_packed = st_sample;\n");
    EXPECT_EQ(rewritten("precise float a = 1.;\n"), "precise float a = 1.;\n");
    EXPECT_EQ(rewritten("layout(row_major) uniform;\n"), "layout(row_major) uniform;\n");
    EXPECT_EQ(rewritten("#ifdef GL_ES\n"), "#ifdef tidemark_GL_ES\n");
    EXPECT_EQ(rewritten("#ifdef GL_ES\n", {.version = Version::es_300}), "#ifdef GL_ES\n");
    EXPECT_EQ(rewritten("#if __VERSION__ > 100\n"), "#if tidemark_VERSION > 100\n");
}

TEST(Rewrite, stray_bytes_are_blanked) {
    EXPECT_EQ(rewritten("float a\xc2\xa0= 1.; // \xc3\xa9\n"), "float a  = 1.; // \xc3\xa9\n");
    EXPECT_EQ(rewritten(std::string("/* \0 */ float a = 1.;\0\n", 23)), "/*   */ float a = 1.; \n");
}

TEST(Rewrite, signs_of_macros_are_separated) {
    EXPECT_EQ(rewritten("#define N(x) -x\nfloat a = b-N(c)-d;\n"),
              "#define N(x) - x\nfloat a = b- N(c)-d;\n");
    EXPECT_EQ(rewritten("#define D(x, y) x-y\nfloat a = D(1., -1.);\n"),
              "#define D(x, y) x- y\nfloat a = D(1., -1.);\n");
    EXPECT_EQ(rewritten("#define R(x) x*2.\n#define S(x) (-R(x))\nfloat a = -R(-1.)+S(-2.);\n"),
              "#define R(x) x*2.\n#define S(x) (- R(x))\nfloat a = - R(-1.)+ S(-2.);\n");
    EXPECT_EQ(rewritten("#define C(x, y,) x\n"), "#define C(x, y ) x\n");
}

TEST(Rewrite, late_uniform_declarations_are_replaced_by_ours) {
    EXPECT_EQ(rewritten("float t() { return iTime; }\nuniform float iTime;\n"),
              "float t() { return iTime; }\n\n");
    EXPECT_EQ(rewritten("uniform float iTime;\nfloat t() { return iTime; }\n"),
              "uniform float iTime;\nfloat t() { return iTime; }\n");
    EXPECT_EQ(rewritten("float t() { return iTime; }\nuniform int iTime;\n"),
              "float t() { return iTime; }\nuniform int iTime;\n");
    EXPECT_EQ(rewritten("#ifdef GL_X\nuniform\nvec4 iMouse;\n#endif\n"), "#ifdef GL_X\n\n\n#endif\n");
}

TEST(Rewrite, line_numbers_are_unchanged) {
    const std::string text =
        "#version 300 es\nfloat packed,\n  b;\n#define N(x) -x\nvoid mainImage(out vec4 o,\n vec2 p)"
        "\n{ o += b-N(p.x); }\n#extension \\\n GL_X : enable\nfloat last;\n";
    const std::string result = rewritten(text);
    EXPECT_EQ(count(result, "\n"), count(text, "\n"));
    EXPECT_TRUE(result.ends_with("\nfloat last;\n"));
}

TEST(Rewrite, junk_takes_linear_time) {
    for (const char* piece :
         {"float a=(", "void mainImage(out vec4 a,", "uniform float iTime,", "struct {", "#define N(a) -a\n",
          "N(-", "for(float a", "float a,", "#if 1\n", "mainImage("}) {
        std::string text;
        while (text.size() < 700'000)
            text += piece;
        EXPECT_GE(rewritten(text).size(), text.size()) << piece;
    }
}

} // namespace tidemark::glsl::rewrite_test
