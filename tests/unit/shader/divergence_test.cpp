// Which derivatives are taken where neighbouring pixels may have gone another way.
#include "shader/undefined_behaviour.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::divergence_test {

/// `call@line<line of the condition` or `call@line|line of the exit`, each found one, with ` called` where
/// that stands before a call of its function; iChannel0 has mipmaps.
std::string found_in(const std::string& text) {
    text::MappedText source;
    source.append("#version 330 core\nuniform float iTime;\nuniform int iFrame;\nuniform sampler2D "
                  "iChannel0, iChannel1;\n",
                  "", 0);
    source.append(text, "a.glsl", 1);
    source.append("void main() { vec4 c; mainImage(c, gl_FragCoord.xy); }\n", "", 0);
    const auto parsed = ParsedText::read(std::move(source), {});
    EXPECT_TRUE(parsed);
    const ParsedText& read = **parsed;
    std::string result;
    const auto line = [&](NodeId node) {
        const text::Token& token = read.tokens()[read.words()[read.tree()[node].begin].used];
        return std::to_string(read.source().lines().locate(token.line).line);
    };
    for (const Divergent& each :
         find_divergent(read, find_facts(read), [](std::string_view name) { return name == "iChannel0"; }))
        result += (result.empty() ? "" : " ") + std::string(called_name(read, each.call)) + "@" +
                  line(each.call) + (each.branch.exit ? "|" : "<") + line(each.branch.at) +
                  (each.branch.called ? " called" : "");
    return result;
}

/// mainImage of those lines, the first of which is line 2.
std::string in_image(const std::string& lines) {
    return found_in("void mainImage(out vec4 c, in vec2 p) {\n" + lines + "\n}\n");
}

TEST(Divergence, UniformControlFlowPasses) {
    EXPECT_EQ(in_image("c = vec4(dFdx(p.x));"), "");
    EXPECT_EQ(in_image("if (iTime > 1.0)\nc = texture(iChannel0, p);"), "");
    EXPECT_EQ(in_image("for (int i = 0; i < 4; ++i)\nc += texture(iChannel0, p * float(i));"), "");
    EXPECT_EQ(in_image("float k = iTime * 2.0; if (k > 1.0) k += 1.0;\nif (k > 2.0) c = fwidth(p).xyxy;"),
              "");
}

TEST(Divergence, AVaryingConditionDiverges) {
    EXPECT_EQ(in_image("if (p.x > 9.0)\nc = vec4(dFdx(p.x));"), "dFdx@3<2");
    EXPECT_EQ(in_image("if (p.x > 9.0) ;\nelse c = vec4(fwidth(p.x));"), "fwidth@3<2");
    EXPECT_EQ(in_image("c = p.x > 9.0 ? texture(iChannel0, p) : vec4(0);"), "texture@2<2");
    EXPECT_EQ(in_image("bool b = p.x > 9.0 && dFdx(p.y) > 0.0;"), "dFdx@2<2");
    EXPECT_EQ(in_image("while (c.x < p.x)\nc += texture(iChannel0, p);"), "texture@3<2");
    EXPECT_EQ(in_image("if (dFdx(p.x) > p.x) c = vec4(0);"), "") << "the condition itself is asked by all";
}

TEST(Divergence, DivergencePropagatesThroughVariables) {
    EXPECT_EQ(in_image("float d = length(p);\nif (d > 9.0) c = vec4(dFdx(d));"), "dFdx@3<3");
    EXPECT_EQ(in_image("int n = 0; if (p.x > 9.0) n = 1;\nif (n == 1) c = vec4(dFdx(p.x));"), "dFdx@3<3");
    EXPECT_EQ(in_image("vec2 q; q.x = p.x;\nif (q.y > 9.0) c = vec4(dFdx(p.x));"), "dFdx@3<3");
}

TEST(Divergence, ALoopLeftBySomePixelsDiverges) {
    EXPECT_EQ(
        in_image("for (int i = 0; i < 4; ++i) {\nif (p.x > float(i)) break;\nc += texture(iChannel0, p); }"),
        "texture@4<2");
    EXPECT_EQ(
        in_image(
            "for (int i = 0; i < 4; ++i) {\nif (iTime > float(i)) break;\nc += texture(iChannel0, p); }"),
        "");
}

TEST(Divergence, GoesThroughFunctions) {
    EXPECT_EQ(found_in("vec4 look(vec2 q) { return texture(iChannel0, q); }\n"
                       "void mainImage(out vec4 c, in vec2 p) { if (p.x > 9.0) c = look(p); }\n"),
              "texture@1<2 called");
    EXPECT_EQ(found_in("float f(float x) { return x; }\n"
                       "void mainImage(out vec4 c, in vec2 p) {\nif (f(p.x) > 9.0) c = vec4(dFdx(p.x)); }\n"),
              "dFdx@3<3");
    EXPECT_EQ(found_in("vec4 unused(vec2 q) { if (q.x > 9.0) return vec4(dFdx(q.x)); return vec4(0); }\n"
                       "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 1); }\n"),
              "");
}

TEST(Divergence, CodeAfterAVaryingReturnOrDiscardDiverges) {
    EXPECT_EQ(in_image("if (p.x > 9.0) return;\nc = vec4(dFdx(p.x));"), "dFdx@3|2");
    EXPECT_EQ(in_image("if (p.x > 9.0) discard;\nc = texture(iChannel0, p);"), "texture@3|2");
    EXPECT_EQ(in_image("if (iTime > 1.0) {\nif (p.x > 9.0) return;\n}\nc = vec4(dFdx(p.x));"), "dFdx@5|3");
    EXPECT_EQ(in_image("for (int i = 0; i < 4; ++i)\nif (p.x > float(i)) return;\nc = vec4(dFdx(p.x));"),
              "dFdx@4|3");
    EXPECT_EQ(in_image("c = vec4(dFdx(p.x));\nif (p.x > 9.0) return;"), "") << "it stands before";
    EXPECT_EQ(in_image("if (iTime > 1.0) return;\nc = vec4(dFdx(p.x));"), "") << "all leave together";
    EXPECT_EQ(in_image("if (p.x > 9.0) { c = vec4(1); }\nelse c = vec4(2);\nc = vec4(dFdx(p.x));"), "");
}

TEST(Divergence, AnExitDivergesOnlyReachableCode) {
    EXPECT_EQ(in_image("if (iTime > 1.0) { if (p.x > 9.0) return; }\nelse c = vec4(dFdx(p.x));"), "");
    EXPECT_EQ(in_image("switch (iFrame) {\ncase 0: if (p.x > 9.0) return;\nbreak;\n"
                       "default: c = vec4(dFdx(p.x));\n}"),
              "");
    EXPECT_EQ(in_image("switch (iFrame) {\ncase 0: if (p.x > 9.0) return;\n"
                       "default: c = vec4(dFdx(p.x));\n}"),
              "dFdx@4|3");
}

TEST(Divergence, AContinueDivergesTheRestOfTheBody) {
    const std::string loop = "for (int i = 0; i < 4; ++i) {\nc += texture(iChannel0, p);\n"
                             "if (p.x > float(i)) continue;\n";
    EXPECT_EQ(in_image(loop + "}\nc *= dFdx(p.x);"), "");
    EXPECT_EQ(in_image(loop + "c *= dFdx(p.x);\n}"), "dFdx@5|4");
    EXPECT_EQ(in_image("int n = 0; for (int i = 0; i < 4; ++i) {\nif (p.x > float(i)) continue;\n++n;\n}\n"
                       "if (n > 2) c *= dFdx(p.x);"),
              "dFdx@6<6")
        << "some have counted further";
}

TEST(Divergence, ABreakInASwitchDoesNotLeaveTheLoop) {
    EXPECT_EQ(in_image("for (int i = 0; i < 4; ++i) {\nc += texture(iChannel0, p);\n"
                       "switch (int(p.x)) { case 0: break; default: c *= 2.0; }\n}"),
              "");
}

TEST(Divergence, AReturnAffectsItsOwnFunctionOnly) {
    EXPECT_EQ(found_in("float f(float x) { if (x > 9.0) return 1.0; float d = 2.0; return d; }\n"
                       "void mainImage(out vec4 c, in vec2 p) {\nfloat e = f(p.x);\nc = vec4(dFdx(e));\n"
                       "float d = 1.0; if (d > 2.0) c = vec4(dFdy(e)); }\n"),
              "");
    EXPECT_EQ(found_in("void cut(float x) { if (x > 9.0) discard; }\n"
                       "void mainImage(out vec4 c, in vec2 p) {\ncut(p.x);\nc = vec4(dFdx(p.x)); }\n"),
              "dFdx@4|3");
    EXPECT_EQ(
        found_in("void cut() { discard; }\n"
                 "void mainImage(out vec4 c, in vec2 p) {\nif (p.x > 9.0) cut();\nc = vec4(dFdx(p.x)); }\n"),
        "dFdx@4|3");
    EXPECT_EQ(found_in("vec4 look(vec2 q) { return texture(iChannel0, q); }\n"
                       "void mainImage(out vec4 c, in vec2 p) {\nif (p.x > 9.0) return;\nc = look(p); }\n"),
              "texture@1|3 called");
    EXPECT_EQ(
        found_in("int n = 0;\nvoid count(float x) { if (x > 9.0) return; n = 1; }\n"
                 "void mainImage(out vec4 c, in vec2 p) {\ncount(p.x);\nif (n > 0) c = vec4(dFdx(p.x)); }\n"),
        "dFdx@5<5")
        << "a global is seen by all";
}

TEST(Divergence, LookUpsWithoutMipmapsNeedNoNeighbours) {
    EXPECT_EQ(in_image("if (p.x > 9.0)\nc = texture(iChannel1, p) + textureLod(iChannel0, p, 0.0) +\n"
                       "texelFetch(iChannel0, ivec2(p), 0);"),
              "");
}

/// Whether each found one of mainImage is harmless: h, or not: n.
std::string harm_in(const std::string& lines) {
    text::MappedText source;
    source.append("#version 330 core\nuniform float iTime;\nuniform sampler2D iChannel0;\n", "", 0);
    source.append("void mainImage(out vec4 c, in vec2 p) {\n" + lines + "\n}\n", "a.glsl", 1);
    source.append("void main() { vec4 c; mainImage(c, gl_FragCoord.xy); }\n", "", 0);
    const auto parsed = ParsedText::read(std::move(source), {});
    EXPECT_TRUE(parsed);
    std::string result;
    for (const Divergent& each :
         find_divergent(**parsed, find_facts(**parsed), [](std::string_view) { return true; }))
        result += each.harmless ? 'h' : 'n';
    return result;
}

TEST(Divergence, CoordinatesFromBeforeTheBranchAreHarmless) {
    EXPECT_EQ(harm_in("if (p.x > 9.0) c = texture(iChannel0, 2.0 * p + iTime);"), "h");
    EXPECT_EQ(harm_in("vec2 q = vec2(length(p)); if (p.x > 9.0) c = texture(iChannel0, q.xy / 3.0);"), "h");
    EXPECT_EQ(harm_in("vec2 q = p; if (p.x > 9.0) { q = p * p; c = texture(iChannel0, q); }"), "n");
    EXPECT_EQ(harm_in("if (p.x > 9.0) { vec2 q = sin(p); c = texture(iChannel0, q); }"), "n");
    EXPECT_EQ(harm_in("vec2 q = p; while (q.x > c.x) { c += texture(iChannel0, q); q *= 2.0; }"), "n");
    EXPECT_EQ(harm_in("if (p.x > 9.0) return; vec2 q = sin(p); c = texture(iChannel0, q);"), "n");
    EXPECT_EQ(harm_in("if (p.x > 9.0) c = texture(iChannel0, sin(p), -100.0);"), "h");
}

} // namespace tidemark::glsl::divergence_test
