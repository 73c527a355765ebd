// A buffer drawn at half its size: what it and its readers then say, and where it is not to be had.
#include "glsl_support.hpp"
#include "shader/cuts.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::half_size_test {

const std::string k_head =
    "uniform vec3 iResolution; uniform sampler2D iChannel0, iChannel1; out vec4 shown;\n";
const std::string k_tail = "void main() { mainImage(shown, vec2(1.0)); }\n";

std::string pass(const std::string& main_image) {
    return k_head + main_image + k_tail;
}

const std::string k_buffer =
    pass("void mainImage(out vec4 c, in vec2 p) { c = vec4(sin(p.x), cos(p.y), 0, 1); }\n");

/// A pass that reads the buffer by iChannel0 and something else by iChannel1.
std::string reading(const std::string& read) {
    return pass("void mainImage(out vec4 c, in vec2 p) { vec2 uv = p / iResolution.xy; c = " + read +
                "; }\n");
}

struct Texts {
    std::string buffer, reader;
};

/// `none` twice where it is not to be had.
Texts halved(const std::string& buffer, const std::string& reader, bool repeats = false,
             std::vector<BufferSampler> own = {}, const char* reader_file = "b.glsl") {
    const auto first = parsed(buffer), second = parsed(reader, reader_file);
    const TreeFacts facts = find_facts(*first), others = find_facts(*second);
    const BufferReader passes[]{{*first, facts, std::move(own)}, {*second, others, {{"iChannel0", repeats}}}};
    const auto cut = half_size(passes, 0, WorkEstimate(*first, facts));
    if (!cut)
        return {"none", "none"};
    EXPECT_TRUE(cut->hangs_on_size);
    EXPECT_GT(cut->work, 0);
    return {cured(buffer, "a.glsl", {&cut->change, 1}).value_or("refused"),
            cured(reader, "b.glsl", {&cut->change, 1}).value_or("refused")};
}

std::string read_as(const std::string& read, bool repeats = false) {
    return halved(k_buffer, reading(read), repeats).reader;
}

TEST(HalfSize, TheBufferIsDrawnIntoAQuarterOfItself) {
    const Texts texts = halved(k_buffer, reading("texture(iChannel0, uv)"));
    EXPECT_EQ(texts.buffer, pass("void mainImage(out vec4 c, in vec2 p) { if (any(greaterThan(p, 0.5 * "
                                 "iResolution.xy + 1.0))) { c = vec4(0.0); return; } p *= 2.0; "
                                 "c = vec4(sin(p.x), cos(p.y), 0, 1); }\n"));
}

TEST(HalfSize, ReadersUseTheReducedCoordinates) {
    EXPECT_EQ(read_as("texture(iChannel0, uv + 0.1) + texture(iChannel1, uv)"),
              reading("texture(iChannel0, 0.5 * clamp(uv + 0.1, 0.0, 1.0)) + texture(iChannel1, uv)"));
    EXPECT_EQ(read_as("texture(iChannel0, uv)", true),
              reading("texture(iChannel0, max(0.5 * fract(uv), 0.5 / iResolution.xy))"));
    EXPECT_EQ(read_as("textureLod(iChannel0, uv, 0.0)"),
              reading("textureLod(iChannel0, 0.5 * clamp(uv, 0.0, 1.0), 0.0)"));
    EXPECT_EQ(
        read_as("texelFetch(iChannel0, ivec2(p) + 1, 0)"),
        reading("textureLod(iChannel0, max(0.5 * (vec2(ivec2(p) + 1) + 0.5), 0.5) / iResolution.xy, 0.0)"));
}

TEST(HalfSize, AMacroIsRewrittenOnce) {
    const std::string macro = "#define T(x) texture(iChannel0, x)\n", uses = reading("T(uv) + T(uv.yx)");
    EXPECT_EQ(halved(k_buffer, macro + uses).reader,
              "#define T(x) texture(iChannel0, 0.5 * clamp(x, 0.0, 1.0))\n" + uses);
    EXPECT_EQ(
        halved(k_buffer, "#define T(s, x) texture(s, x)\n" + reading("T(iChannel0, uv) + T(iChannel1, uv)"))
            .reader,
        "none")
        << "the other sampler would be led there, too";
}

TEST(HalfSize, RefusedIfASizeIsRead) {
    for (const std::string read :
         {"vec4(textureSize(iChannel0, 0), 0, 0)", "texture(iChannel0, uv, 1.0)", "texture(iChannel1, uv)",
          "texelFetch(iChannel0, ivec2(p), int(p.x))", "textureGrad(iChannel0, uv, uv, uv)"})
        EXPECT_EQ(read_as(read), "none") << read;
    EXPECT_EQ(halved(k_buffer, k_head +
                                   "vec4 f(sampler2D s, vec2 p) { return texture(s, p); }\n"
                                   "void mainImage(out vec4 c, in vec2 p) { c = f(iChannel0, p); }\n" +
                                   k_tail)
                  .reader,
              "none");
}

TEST(HalfSize, RefusedForABufferThatReadsItself) {
    const std::string reader = reading("texture(iChannel0, uv)");
    EXPECT_EQ(halved(reader, reader, false, {{"iChannel0"}}).buffer, "none");
}

TEST(HalfSize, RefusedForOtherUsesOfThePixel) {
    const std::string reader = reading("texture(iChannel0, uv)");
    EXPECT_EQ(halved(pass("void mainImage(out vec4 c, in vec2 p) { c = gl_FragCoord; }\n"), reader).buffer,
              "none");
    EXPECT_EQ(halved(pass("void mainImage(out vec4 c, const in vec2 p) { c = vec4(p.x); }\n"), reader).buffer,
              "none");
    EXPECT_EQ(halved(k_buffer, reader, false, {}, "a.glsl").buffer, "none") << "one file for both";
}

} // namespace tidemark::glsl::half_size_test
