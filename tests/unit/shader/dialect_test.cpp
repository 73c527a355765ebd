#include "glsl_support.hpp"
#include "shader/pass_reading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::dialect_test {

using scene::TextureKind;
using testing::IsEmpty;

const std::string k_main_image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";

std::vector<std::string> names(const std::string& text, scene::PassKind kind = scene::PassKind::image) {
    scene::Scene scene = scene_of(text);
    scene.passes[0].kind = kind;
    std::vector<std::string> list;
    for (const Dialect& dialect : PassReading(scene, scene.passes[0]).dialects(Precision::single))
        list.push_back(to_string(dialect));
    return list;
}

TEST(Dialects, desktop_first_and_main_before_the_text) {
    EXPECT_EQ(names(k_main_image), (std::vector<std::string>{"330 core", "330 core, main last", "450 core",
                                                             "300 es", "330 core, nothing initialised"}));
}

TEST(Dialects, overloads_of_built_in_functions_are_tried_last) {
    const std::vector<std::string> offered = names("float mix(vec2 a) { return a.x; }\n" + k_main_image);
    EXPECT_EQ(offered.front(), "330 core");
    EXPECT_EQ(offered[4], "330 core, built-in functions overloaded");
}

TEST(Dialects, a_macro_entry_point_is_called_after_its_definition) {
    EXPECT_EQ(names("#define mainImage(O, U) O = vec4(U, 0, 1)\n").front(), "330 core, main last");
    EXPECT_EQ(names("#if 0\n#define mainImage(O, U)\n#endif\n" + k_main_image).front(), "330 core");
    EXPECT_EQ(names("#define main() mainImage(out vec4 o, in vec2 p)\nvoid main() {}\n").front(), "330 core");
    EXPECT_EQ(names("void mainImage(out lowp vec4 o, in vec2 p) {}\n").front(), "330 core, main last");
    EXPECT_EQ(names("vec2 mainSound(int s, float t) { return vec2(0); }", scene::PassKind::sound).front(),
              "330 core");
}

TEST(Dialects, a_main_by_the_author_is_used) {
    EXPECT_EQ(names("out vec4 c;\nvoid main() { c = vec4(1); }\n").front(),
              "330 core, the author's own main");
    for (const char* dead :
         {"#if 0\nvoid main() {}\n#endif\n", "// void main() {}\n", "/* void main() {} */\n",
          "#ifndef GL_ES\nvoid main() {}\n#endif\n", "void main();\n"})
        EXPECT_EQ(names(dead + k_main_image).front(), "330 core") << dead;
}

TEST(Dialects, a_uniform_that_our_main_reads_is_declared_before_our_main) {
    const std::string text =
        "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d, 1); }\n";
    EXPECT_EQ(names(text, scene::PassKind::cubemap).front(), "330 core");
    EXPECT_EQ(names("uniform vec3 iResolution;\n" + text, scene::PassKind::cubemap).front(), "330 core");
    EXPECT_EQ(names("uniform vec2 iResolution;\n" + text, scene::PassKind::cubemap).front(),
              "330 core, main last");
}

TEST(Dialects, each_glsl_version_has_a_header) {
    const scene::Scene scene = scene_of("#ifdef GL_ES\n#endif\n" + k_main_image);
    const auto text = [&](Version version) {
        return assemble(scene, scene.passes[0], {.version = version}).text();
    };
    EXPECT_TRUE(text(Version::core_450).starts_with("#version 450 core\n#define HW_PERFORMANCE 1\n"));
    EXPECT_TRUE(text(Version::es_300).starts_with("#version 300 es\nprecision highp float;\n"));
    EXPECT_EQ(count(text(Version::es_300), "precision highp sampler3D;\n"), 1);
    EXPECT_EQ(count(text(Version::es_300), "tidemark_GL_ES"), 0);
    EXPECT_EQ(count(text(Version::core_450), "#define tidemark_GL_ES 1\n"), 1);
    EXPECT_TRUE(std::string_view(vertex_shader(Version::es_300)).starts_with("#version 300 es\n"));
    EXPECT_TRUE(std::string_view(vertex_shader(Version::core_450)).starts_with("#version 330 core\n"));
}

TEST(Dialects, only_named_uniforms_are_declared) {
    EXPECT_EQ(count(source_of(k_main_image).text(), "iCh0"), 0);
    EXPECT_EQ(count(source_of(k_main_image).text(), "#define"), 1);
    const std::string text =
        source_of("float f() { return iCh2.time + iGlobalTime + iChannel[1].time; }\n" + k_main_image).text();
    EXPECT_EQ(count(text, "uniform struct { sampler2D sampler; vec3 size; float time; int loaded; } iCh2;\n"),
              1);
    EXPECT_EQ(count(text, "} iCh0;"), 0);
    EXPECT_EQ(count(text, "#define iGlobalTime iTime\n"), 1);
    EXPECT_EQ(count(text, "uniform struct { vec3 resolution; float time; } iChannel[4];\n"), 1);
    EXPECT_EQ(count(source_of("#define iGlobalTime 1.\n" + k_main_image).text(), "#define iGlobalTime"), 1);
    EXPECT_EQ(count(source_of("#define HW_PERFORMANCE 0\n" + k_main_image).text(), "#define HW_PERFORMANCE"),
              1);
}

TEST(Dialects, the_sound_pass_has_its_own_uniforms) {
    scene::Scene scene = scene_of("vec2 mainSound(float t) { return vec2(0); }\n");
    scene.passes[0].kind = scene::PassKind::sound;
    const std::string text = assemble(scene, scene.passes[0]).text();
    EXPECT_EQ(count(text, "uniform float iTime;"), 0);
    EXPECT_EQ(count(text, "uniform float iSampleRate;"), 1);
    EXPECT_EQ(count(text, "vec2 mainSound(float time);\n"), 1);
}

std::vector<ChannelKinds> kinds_for(const scene::Scene& scene, const std::string& complaint,
                                    std::string_view piece) {
    const ShaderSource source = assemble(scene, scene.passes[0]);
    return channel_kinds_to_try(scene, scene.passes[0], source,
                                "0:" + std::to_string(line_of(source, piece)) + "(3): error: " + complaint +
                                    "\n");
}

constexpr const char* k_complaint =
    "no matching function for call to `texture(sampler2D, vec3)'; candidates are:";
constexpr auto flat = TextureKind::flat;
constexpr auto cube = TextureKind::cube;
constexpr auto volume = TextureKind::volume;

TEST(ChannelKinds, are_inferred_from_the_drivers_complaint) {
    const scene::Scene scene = scene_of(k_main_image + "vec4 a() { return texture(iChannel0, vec2(0)); }\n"
                                                       "vec4 b() { return texture(iChannel2, vec3(0)); }\n");
    const auto kinds = kinds_for(scene, k_complaint, "vec4 b()");
    ASSERT_GE(kinds.size(), 2u);
    EXPECT_EQ(kinds[0], (ChannelKinds{flat, flat, cube, flat}));
    EXPECT_EQ(kinds[1], (ChannelKinds{flat, flat, volume, flat}));
    EXPECT_THAT(kinds_for(scene, "syntax error", "vec4 b()"), IsEmpty());
}

TEST(ChannelKinds, specified_channels_keep_their_kind) {
    scene::Scene scene = scene_of(k_main_image + "vec4 a() { return texture(iChannel0, vec3(0)); }\n");
    scene.passes[0].channels[0].where = {"a.glsl", 1, 0};
    EXPECT_THAT(kinds_for(scene, k_complaint, "vec4 a()"), IsEmpty());
}

TEST(ChannelKinds, a_macro_hides_the_channel) {
    const scene::Scene scene =
        scene_of("#define T iChannel1\n" + k_main_image + "vec4 a() { return texture(T, vec3(0)); }\n");
    const auto kinds = kinds_for(scene, k_complaint, "vec4 a()");
    ASSERT_EQ(kinds.size(), 2u);
    EXPECT_EQ(kinds[0], (ChannelKinds{flat, cube, flat, flat}));
}

TEST(EntryPoints, missing_and_multiple_entry_points_are_reported) {
    const auto problems = [](const std::string& text) {
        const scene::Scene scene = scene_of(text);
        std::string words;
        for (const Diagnostic& diagnostic : PassReading(scene, scene.passes[0]).problems())
            words += to_string(diagnostic) + "\n";
        return words;
    };
    EXPECT_EQ(problems(k_main_image), "");
    EXPECT_EQ(problems("#define mainImage(O, U) O = vec4(1)\n"), "");
    EXPECT_EQ(problems("#if 0\n" + k_main_image + "#endif\n" + k_main_image), "");
    EXPECT_EQ(problems("float a;\n"), "a.glsl:1: error: the text has no mainImage\n");
    EXPECT_EQ(
        problems(k_main_image + "\n" + k_main_image),
        "a.glsl:3:6: error: mainImage is defined again: put each of ShaderToy's tabs into a file of its own\n"
        "a.glsl:1:6: note: first defined here\n");
}

TEST(PassReading, characters_that_glsl_lacks_are_named) {
    const auto problems = [](const std::string& text) {
        const scene::Scene scene = scene_of(text + k_main_image);
        const PassReading reading(scene, scene.passes[0]);
        std::string words;
        for (const Diagnostic& diagnostic : reading.problems())
            words += to_string(diagnostic) + "\n";
        EXPECT_EQ(reading.may_be_drawn_wrong(), !words.empty());
        return words;
    };
    EXPECT_EQ(problems("float x = \u22120.5;\n"),
              "a.glsl:1:11: error: '\u2212' (U+2212) is not a character of GLSL: write -\n");
    EXPECT_EQ(
        problems("float t\u0394 = 0.5;\n"),
        "a.glsl:1:8: error: '\u0394' (U+0394) is not a character of GLSL: names have letters a to z and A "
        "to Z, digits and _\n");
    EXPECT_EQ(problems("float x = 2.0 \u00d7 3.0;\n"),
              "a.glsl:1:15: error: '\u00d7' (U+00D7) is not a character of GLSL: write *\n");
    EXPECT_EQ(
        problems("#define HALF \u00bd\nfloat x = HALF;\n"),
        "a.glsl:1:14: error: '\u00bd' (U+00BD) is not a character of GLSL: names have letters a to z and "
        "A to Z, digits and _\n");
    EXPECT_EQ(problems("float \xff;\n"),
              "a.glsl:1:7: error: a byte that is not UTF-8 (0xff) is not a character of GLSL: names have "
              "letters a to z and A to Z, digits and _\n");
    for (const char* fine : {"// \u2212 \u0394\n", "/* \u00bd */\n", "#if 0\n\u2212\n#endif\n",
                             "#define UNUSED \u2212\n", "float x =\u00a00.5;\u200b\n"}) // blanks are blanks
        EXPECT_EQ(problems(fine), "") << fine;
}

TEST(PassReading, reachable_discards_are_detected) {
    const auto discards = [](const std::string& text) {
        const scene::Scene scene = scene_of(text + k_main_image);
        return PassReading(scene, scene.passes[0]).discards();
    };
    EXPECT_TRUE(discards("void f(float x) { if (x > 0.) discard; }\n"));
    EXPECT_TRUE(discards("#define STOP discard\n"));
    EXPECT_FALSE(discards("// discard;\n"));
    EXPECT_FALSE(discards("#if 0\nvoid f() { discard; }\n#endif\n"));
    EXPECT_FALSE(discards("float discarded;\n"));
}

} // namespace tidemark::glsl::dialect_test
