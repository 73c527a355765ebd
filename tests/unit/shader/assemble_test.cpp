#include "glsl_support.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::assemble_test {

constexpr const char* k_uniforms[] = {
    "vec3 iResolution",
    "float iTime",
    "float iTimeDelta",
    "float iFrameRate",
    "int iFrame",
    "vec4 iMouse",
    "vec4 iDate",
    "float iSampleRate",
    "float iChannelTime[4]",
    "vec3 iChannelResolution[4]",
    "sampler2D iChannel0",
    "sampler2D iChannel1",
    "sampler2D iChannel2",
    "sampler2D iChannel3",
};

const std::string k_main_image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";

std::string declaration(const std::string& uniform) {
    return "uniform " + uniform + ";\n";
}

TEST(Assemble, declares_the_knobs_that_a_pass_names) {
    const std::string text =
        "#iUniform float used = 1.0\n#iUniform float unused = 1.0\n#iUniform vec2 own = vec2(1.0, "
        "2.0)\nuniform vec2 own;\n#define LATER used\n"
        "void mainImage(out vec4 c, vec2 p) { c = vec4(LATER, own, 1.0); }\n";
    const std::string source = source_of(text).text();
    EXPECT_EQ(count(source, "uniform float used;"), 1);
    EXPECT_EQ(count(source, "unused"), 0);
    EXPECT_EQ(count(source, "uniform vec2 own;"), 1);
}

TEST(Assemble, declares_every_uniform_of_shadertoy_once) {
    const ShaderSource source = source_of(k_main_image);
    for (const char* uniform : k_uniforms)
        EXPECT_EQ(count(source.text(), declaration(uniform)), 1) << uniform;
    EXPECT_EQ(count(source.text(), "uniform "), int(std::size(k_uniforms)));
}

TEST(Assemble, begins_with_the_version) {
    EXPECT_TRUE(source_of(k_main_image).text().starts_with("#version 330 core\n"));
    EXPECT_TRUE(std::string_view(k_vertex_shader).starts_with("#version 330 core\n"));
}

TEST(Assemble, the_author_s_text_is_untouched) {
    const std::string text = "// caf\xc3\xa9 \t\n#define A(x) \\\n x\n\n" + k_main_image;
    EXPECT_TRUE(source_of(text).text().ends_with("}\n" + text));
}

TEST(Assemble, alpha_is_1_and_the_initial_colour_is_black) {
    const std::string text = source_of(k_main_image).text();
    EXPECT_EQ(count(text, "    vec4 tidemark_pixel = vec4(0.0, 0.0, 0.0, 1.0);\n"
                          "    vec2 tidemark_at = gl_FragCoord.xy;\n"
                          "    mainImage(tidemark_pixel, tidemark_at);\n"
                          "    tidemark_color = vec4(tidemark_pixel.rgb, 1.0);\n"),
              1);
}

TEST(Assemble, knobs_are_uniforms) {
    const std::string text =
        source_of("#iUniform float a = 1.0\n#iUniform color3 b = 1.0\n#iUniform ivec2 c = 1\n"
                  "void f() { a; b; c; }\n" +
                  k_main_image)
            .text();
    EXPECT_EQ(count(text, "uniform float a;\nuniform vec3 b;\nuniform ivec2 c;\n"), 1);
}

TEST(Assemble, author_declarations_are_not_repeated) {
    const std::string text = source_of("#iUniform float k = 1.0\n"
                                       "uniform vec3 iResolution;\n"
                                       "uniform highp float iTime, k; // iFrame\n"
                                       "uniform vec3 iChannelResolution[4];\n" +
                                       k_main_image)
                                 .text();
    EXPECT_EQ(count(text, declaration("vec3 iResolution")), 1);
    EXPECT_EQ(count(text, declaration("vec3 iChannelResolution[4]")), 1);
    EXPECT_EQ(count(text, declaration("float iTime")), 0);
    EXPECT_EQ(count(text, declaration("float k")), 0);
    EXPECT_EQ(count(text, declaration("int iFrame")), 1) << "named in a comment only";
}

TEST(Assemble, inactive_declarations_are_ignored) {
    for (const char* text :
         {"// uniform float iTime;\n", "#define UNIFORM uniform\nfloat t() { return iTime; }\n",
          "#if 0\nuniform float iTime;\n#endif\n", "float uniforms = iTime;\n",
          "#endif\n#if 0\nuniform float iTime;\n#endif\n"})
        EXPECT_EQ(
            count(source_of(text + k_main_image).text(), "\nuniform float iTime;\nuniform float iTimeDelta;"),
            1)
            << text;
}

TEST(Assemble, an_unfinished_declaration_ends_at_the_next_declaration) {
    const std::string text =
        source_of("uniform float a\n#define B iFrame\nuniform float iTime;" + k_main_image).text();
    EXPECT_EQ(count(text, declaration("int iFrame")), 1);
    EXPECT_EQ(count(text, declaration("float iTime")), 0);
}

TEST(Assemble, the_author_s_version_is_blanked_in_its_place) {
    const ShaderSource source =
        source_of("// mine\n#version 300 es // why\nprecision highp float;\n" + k_main_image);
    EXPECT_EQ(count(source.text(), "#version"), 1);
    EXPECT_EQ(count(source.text(), "// mine\n // why\nprecision highp float;\n"), 1);
}

TEST(Assemble, lines_map_to_the_authors_lines) {
    scene::Scene scene;
    scene.passes.resize(1);
    scene.passes[0].text.append("\n\nfirst\n", "main.glsl", 1);
    scene.passes[0].text.append("inner\n", "lib/b.glsl", 7);
    scene.passes[0].text.append("#version 100\nlast\n", "main.glsl", 4);
    const ShaderSource source = assemble(scene, scene.image());
    const auto where = [&](std::string_view piece) { return source.lines().locate(line_of(source, piece)); };
    EXPECT_EQ(where("first"), (SourceLocation{"main.glsl", 3, 0}));
    EXPECT_EQ(where("inner"), (SourceLocation{"lib/b.glsl", 7, 0}));
    EXPECT_EQ(where("last"), (SourceLocation{"main.glsl", 5, 0}));
    EXPECT_EQ(where("#version 330 core"), SourceLocation{});
    EXPECT_EQ(where("void main()"), SourceLocation{});
    EXPECT_EQ(source.line_count(), count(source.text(), "\n"));
}

TEST(Assemble, our_main_precedes_the_authors_macros) {
    const ShaderSource source = source_of("#define color nonsense\n" + k_main_image);
    EXPECT_LT(line_of(source, "void main()"), line_of(source, "#define color"));
    EXPECT_LT(line_of(source, "void mainImage(out vec4 fragColor, in vec2 fragCoord);"),
              line_of(source, "void main()"));
}

TEST(Assemble, our_main_follows_a_main_image_macro) {
    const ShaderSource source =
        source_of("#define mainImage(O,U) void f(out vec4 O, vec2 U)\nmainImage(o,u){}");
    EXPECT_GT(line_of(source, "void main()"), line_of(source, "#define mainImage"));
    EXPECT_EQ(count(source.text(), "void mainImage(out vec4 fragColor"), 0);
    EXPECT_EQ(count(source.text(), "void main()"), 1);
    EXPECT_EQ(source.lines().locate(line_of(source, "void main()")), SourceLocation{});
    EXPECT_EQ(source.lines().locate(line_of(source, "mainImage(o,u){}")), (SourceLocation{"a.glsl", 2, 0}));
}

TEST(Assemble, junk_takes_linear_time) {
    std::string text;
    while (text.size() < 1'400'000)
        text += "uniform x ";
    EXPECT_EQ(source_of(text).text().size(), source_of("uniform x").text().size() - 9 + text.size());
}

} // namespace tidemark::glsl::assemble_test
