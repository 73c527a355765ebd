// Cuts: what is proposed to be left out of a text, and what the text then says.
#include "glsl_support.hpp"
#include "shader/cuts.hpp"
#include "shader/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace tidemark::glsl::cut_test {

struct Found {
    std::vector<Cut> cuts;
    size_t endless = 0;
};

Found cuts_of(const std::string& text) {
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    const Cutter cutter(*read, facts);
    return {cutter.cuts(), cutter.endless().size()};
}

std::string with(const std::string& text, const std::vector<Cure>& changes) {
    return cured(text, "a.glsl", changes).value_or("refused");
}

/// Every text that one cut makes of it.
std::vector<std::string> texts_of(const std::string& text) {
    std::vector<std::string> texts;
    for (const Cut& cut : cuts_of(text).cuts)
        texts.push_back(with(text, {cut.change}));
    return texts;
}

bool makes(const std::string& text, const std::string& cut) {
    return std::ranges::count(texts_of(text), cut) == 1;
}

const std::string k_dear = "float dear(float x) { return sin(x) * cos(x) + exp(x); }\n";

std::string in_main(const std::string& statements) {
    return k_dear + "out vec4 c; uniform float u;\nvoid main() { float s = u; " + statements +
           " c.x = s; }\n";
}

TEST(Cut, OperandsOfSumsAndProductsAreRemoved) {
    EXPECT_TRUE(makes(in_main("s = u + dear(u);"), in_main("s = u ;")));
    EXPECT_TRUE(makes(in_main("s = dear(u) - u;"), in_main("s = - u;")));
    EXPECT_TRUE(makes(in_main("s = dear(u) * u;"), in_main("s =  u;")));
    EXPECT_TRUE(makes(in_main("s = u + dear(u) + dear(s);"), in_main("s = u + dear(u) ;")));
    EXPECT_TRUE(makes(in_main("s = u + dear(u) + dear(s);"), in_main("s = u  + dear(s);")));
    EXPECT_FALSE(makes(in_main("s = u + u;"), in_main("s = u ;"))) << "costs next to nothing";
}

TEST(Cut, CostlyFactorsAreComputedWhereTheOtherIsNotZero) {
    const std::string loop = "float far(float x) { for (int i = 0; i < 64; ++i) x = sin(x); return x; }\n";
    const auto guarded = [&](const std::string& statement, const std::string& cut) {
        return makes(loop + in_main(statement), loop + in_main(cut));
    };
    EXPECT_TRUE(guarded("s *= far(u);", "if ((s) != 0.0) s *= far(u);"));
    EXPECT_TRUE(guarded("s = max(u, 0.0) * far(u);",
                        "s = ((max(u, 0.0)) != 0.0 ? max(u, 0.0) * far(u) : float(0));"));
    EXPECT_TRUE(guarded("s = far(s) * u;", "s = ((u) != 0.0 ? far(s) * u : float(0));"));
    EXPECT_FALSE(guarded("s *= sin(u);", "if ((s) != 0.0) s *= sin(u);")) << "costs little";
}

TEST(Cut, UpdatingStatementsAreRemoved) {
    EXPECT_TRUE(makes(in_main("s += dear(u);"), in_main("")));
    EXPECT_TRUE(makes(in_main("if (u > 0.0) { s = dear(u); }"), in_main("")));
    EXPECT_TRUE(makes(in_main("if (u > 0.0) s += dear(u);"), in_main("if (u > 0.0) ;")));
    EXPECT_FALSE(makes(in_main("s = dear(u);"), in_main(""))) << "what it had before may be nothing";
    EXPECT_FALSE(makes(in_main("if (u > 0.0) { c.x = dear(u); return; }"), in_main("")))
        << "goes on elsewhere";
}

TEST(Cut, LoopsRunFewerIterations) {
    for (const std::string head : {"int i = 0; i < @; i++", "int i = 0; @ > i; ++i",
                                   "int i = 0; i < @ && s < 9.0; i += 1", "int i = 0; i != @; ++i"}) {
        const auto loop = [&](const std::string& number) {
            std::string text = head;
            text.replace(text.find('@'), 1, number);
            return in_main("for (" + text + ") s += dear(u);");
        };
        EXPECT_TRUE(makes(loop("64"), loop("48"))) << head;
        EXPECT_TRUE(makes(loop("64"), loop("16"))) << head;
    }
    EXPECT_TRUE(makes(in_main("for (float i = 0.0; i++ < 1e2; ) s += dear(u);"),
                      in_main("for (float i = 0.0; i++ < 50.0; ) s += dear(u);")));
    EXPECT_TRUE(makes(in_main("for (int i = 4; i <= 11; i++) s += dear(u);"),
                      in_main("for (int i = 4; i <= 8; i++) s += dear(u);")))
        << "4 of 8 turns end behind the counter's 8, one late at most";
}

TEST(Cut, AMarchEndsWhereItsStepIsSmallOrLarge) {
    const std::string named = "for (int i = 0; i < 64; ++i) { float d = dear(s); s += d; }";
    EXPECT_TRUE(makes(in_main(named), in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); "
                                              "{ s += d; if (abs(d) < 0.01) break; } }")));
    EXPECT_TRUE(makes(in_main(named), in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); "
                                              "{ s += d; if (s > 20.0) break; } }")));
    EXPECT_TRUE(makes(in_main("for (int i = 0; i < 64; ++i) s += dear(s);"),
                      in_main("for (int i = 0; i < 64; ++i) { float march_step = dear(s); s += march_step; "
                              "if (abs(march_step) > 20.0) break; }")));
    for (const std::string& text :
         texts_of(in_main("for (int i = 0; i < 64; ++i) { s += u; c.y += dear(s); }")))
        EXPECT_EQ(text.find("abs(u)"), std::string::npos) << "a constant step: " << text;
    for (const std::string& text : texts_of(in_main("float d = dear(u); s += d;")))
        EXPECT_EQ(text.find("break"), std::string::npos) << "no loop: " << text;
}

TEST(Cut, AMarchEndsWhereItsStepIsSmallForItsWay) {
    const std::string named = "for (int i = 0; i < 64; ++i) { float d = dear(s); s += d; }";
    for (const std::string share : {"0.001", "0.004"})
        EXPECT_TRUE(makes(in_main(named), in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); "
                                                  "{ s += d; if (abs(d) < " +
                                                  share + " * abs(s)) break; } }")));
    for (const std::string& text :
         texts_of(in_main("vec3 p = vec3(u); for (int i = 0; i < 64; ++i) { float d = dear(p.x); p += d; }")))
        EXPECT_EQ(text.find("abs(p)"), std::string::npos) << "a vector is no way: " << text;
}

TEST(Cut, AMarchEndsByTheComponentThatItSteps) {
    const std::string vector = "vec2 both(float x) { return vec2(sin(x) * cos(x), exp(x)); }\n";
    EXPECT_TRUE(makes(vector + in_main("for (int i = 0; i < 64; ++i) { vec2 h = both(s); s += h.x; }"),
                      vector + in_main("for (int i = 0; i < 64; ++i) { vec2 h = both(s); "
                                       "{ s += h.x; if (abs(h.x) < 0.01) break; } }")));
}

TEST(Cut, AMarchTakesLongerSteps) {
    const std::string slow = "for (int i = 0; i < 64; ++i) { float d = dear(s); s += d * 0.5; }";
    for (const std::string factor : {"1.2", "1.5"})
        EXPECT_TRUE(makes(in_main(slow), in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); s += " +
                                                 factor + " * (d * 0.5); }")));
    for (const std::string& text : texts_of(in_main("while (s < u) { float d = dear(s); s += d; }")))
        EXPECT_EQ(text.find("1.5 * "), std::string::npos) << "it may be endless: " << text;
}

TEST(Cut, TheLimitsThatEndALoopAreChanged) {
    const auto loop = [](const std::string& near, const std::string& far) {
        return in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); if (d < " + near + " || s > " +
                       far + ") break; s += d; }");
    };
    EXPECT_TRUE(makes(loop("0.001", "100."), loop("0.003", "100.")));
    EXPECT_TRUE(makes(loop("0.001", "100."), loop("0.01", "100.")));
    EXPECT_TRUE(makes(loop("0.001", "100."), loop("0.001", "50.0")));
    EXPECT_TRUE(
        makes("#define NEAR 1e-4\n" + loop("NEAR", "9.0"), "#define NEAR 0.001\n" + loop("NEAR", "9.0")));
    EXPECT_TRUE(makes("const float FAR = 80.0;\n" + loop("0.1", "FAR"),
                      "const float FAR = 20.0;\n" + loop("0.1", "FAR")));
    EXPECT_FALSE(makes(loop("0.5", "2.0"), loop("1.5", "2.0"))) << "too large for a threshold";
    EXPECT_FALSE(makes(loop("0.5", "2.0"), loop("0.5", "1.0"))) << "too near for a far plane";
    EXPECT_FALSE(
        makes(in_main("if (s < 0.001) return; s = dear(u);"), in_main("if (s < 0.01) return; s = dear(u);")))
        << "no loop";
}

TEST(Cut, CutsOfOneFamilyAreOrderedByStrength) {
    std::map<std::string, std::vector<double>> families;
    for (const Cut& cut :
         cuts_of(in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); if (d < 1e-4) break; s += d; }"))
             .cuts) {
        EXPECT_GT(cut.chance, 0) << cut.change.reason;
        if (!cut.family.empty())
            families[cut.family].push_back(cut.strength);
    }
    EXPECT_EQ(families.size(), 7U) << "iterations, step near, leap, relative, way far, longer steps, limit";
    for (auto& [family, strengths] : families) {
        std::ranges::sort(strengths);
        EXPECT_EQ(std::ranges::adjacent_find(strengths), strengths.end()) << family;
    }
}

TEST(Cut, ANamedNumberIsChangedAtItsDefinition) {
    const auto text = [](const std::string& said) {
        return said + in_main("for (int i = 0; i < N; i++) s += dear(u);");
    };
    EXPECT_TRUE(makes(text("#define N 64\n"), text("#define N 32\n")));
    EXPECT_TRUE(makes(text("const int N = 64;\n"), text("const int N = 32;\n")));
}

TEST(Cut, CodeOfAnEndlessLoopIsKept) {
    const Found found = cuts_of(in_main("while (s < 9.0) { s += dear(u); }"));
    EXPECT_EQ(found.endless, 1U);
    for (const Cut& cut : found.cuts)
        EXPECT_NE(cut.change.reason.find("leaves the loop"), std::string::npos)
            << "an exit can only end it earlier; the functions that it calls stay: " << cut.change.reason;
    EXPECT_EQ(cuts_of(in_main("int i = 0; while (i++ < 9) { s += dear(u); }")).endless, 0U);
    EXPECT_EQ(cuts_of(in_main("for (int i = 9; i > 0; i--) { s += dear(u); }")).endless, 0U);
    EXPECT_EQ(cuts_of(in_main("for (int i = 0; i < 9; ) { s += dear(u); }")).endless, 1U);
    EXPECT_EQ(cuts_of(in_main("for (;;) { s += dear(u); }")).endless, 1U);
}

TEST(Cut, ANumberReplacesAnExpression) {
    const std::string text = "vec3 dear(vec3 x) { return sin(x) * cos(x); }\nout vec4 c; uniform vec3 u;\n"
                             "void main() { c.xyz = dear(u); }\n";
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    const Cutter cutter(*read, facts);
    const auto found = cutter.replaceables();
    ASSERT_EQ(found.size(), 1U);
    const Cut cut = cutter.replaced(found[0], std::vector{1.0, 0.25, -1e-7});
    EXPECT_NE(with(text, {cut.change}).find("c.xyz = vec3(1.0, 0.25, -1e-07); }"), std::string::npos);
}

std::vector<std::string> levels_of(const std::string& text) {
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    std::vector<std::string> texts;
    for (const Cut& cut :
         Cutter(*read, facts).levels([](std::string_view name) { return name == "noise"; })) {
        EXPECT_GT(cut.work, 0);
        texts.push_back(with(text, {cut.change}));
    }
    return texts;
}

TEST(Cut, ALookUpGetsAFixedLevel) {
    const std::string head = "out vec4 c; in vec2 p; uniform sampler2D noise, flat_one;\n";
    EXPECT_EQ(
        levels_of(head + "void main() { c = texture(noise, p * vec2(2.0)); }\n"),
        (std::vector<std::string>{head + "void main() { c = textureLod(noise, p * vec2(2.0), 0.0); }\n",
                                  head + "void main() { c = textureLod(noise, p * vec2(2.0), 1.0); }\n",
                                  head + "void main() { c = textureLod(noise, p * vec2(2.0), 2.0); }\n",
                                  head + "void main() { c = textureLod(noise, p * vec2(2.0), 3.0); }\n"}));
    EXPECT_EQ(
        levels_of("#define T(x) texture(noise, x)\n" + head + "void main() { c = T(p) + T(c.xy); }\n")[1],
        "#define T(x) textureLod(noise, x, 1.0)\n" + head + "void main() { c = T(p) + T(c.xy); }\n");
    for (const std::string call : {"texture(flat_one, p)", "textureLod(noise, p, 2.0)",
                                   "texture(noise, p, 1.0)", "textureOffset(noise, p, ivec2(1))"})
        EXPECT_TRUE(levels_of(head + "void main() { c = " + call + "; }\n").empty()) << call;
    EXPECT_TRUE(levels_of(head + "void f() { c = texture(noise, p); }\nvoid main() {}\n").empty())
        << "nobody calls it";
    EXPECT_TRUE(levels_of(head + "void main() { while (c.x < p.x) c += texture(noise, c.xy); }\n").empty())
        << "it may never end";
    EXPECT_TRUE(levels_of("#define L texture(noise,\n" + head + "void main() { c = L p); }\n").empty())
        << "the macro says only a part of it";
}

/// `none` where there is nothing to be computed once.
std::string once(const std::string& text) {
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    const auto cut = once_a_pixel(*read, facts, WorkEstimate(*read, facts));
    return cut ? with(text, {cut->change}) : "none";
}

/// A scene whose `map` is called in a loop.
std::string marched(const std::string& map, const std::string& declared = "",
                    const std::string& assigned = "") {
    return "uniform float iTime;\nmat2 turn(float a) { return mat2(cos(a), -sin(a), sin(a), cos(a)); }\n" +
           declared + map + "void mainImage(out vec4 c, vec2 p) {" + assigned +
           " for (int i = 0; i < 9; i++) c += map(p); }\n"
           "out vec4 colour;\nvoid main() { mainImage(colour, vec2(1.0)); }\n";
}

TEST(Cut, InvariantExpressionsAreComputedOncePerPixel) {
    EXPECT_EQ(once(marched("float map(vec2 p) { p *= turn(iTime*.5); return p.x; }\n")),
              marched("float map(vec2 p) { p *= same_everywhere; return p.x; }\n", "mat2 same_everywhere; ",
                      " same_everywhere = turn(iTime*.5);"));
    EXPECT_EQ(once(marched(
                  "float map(vec2 p) { float t = 2.0 * iTime; return p.x * sin(t) + cos(t) + sin(t); }\n")),
              marched("float map(vec2 p) { float t = 2.0 * iTime; return p.x * same_everywhere + "
                      "same_everywhere2 + same_everywhere; }\n",
                      "float same_everywhere; float same_everywhere2; ",
                      " same_everywhere = sin((2.0 * iTime)); same_everywhere2 = cos((2.0 * iTime));"));
}

TEST(Cut, InvariantMacrosAreComputedOncePerPixel) {
    const std::string macros =
        "#define T (iTime * 0.5)\n#define R(a) mat2(cos(a), sin(a), -sin(a), cos(a))\n";
    EXPECT_EQ(once(macros + marched("float map(vec2 p) { p *= R(T); return p.x; }\n")),
              macros + marched("float map(vec2 p) { p *= same_everywhere; return p.x; }\n",
                               "mat2 same_everywhere; ", " same_everywhere = R(T);"));
    EXPECT_EQ(once("#define M p.x * sin(iTime)\n" + marched("float map(vec2 p) { return M; }\n")), "none");
}

TEST(Cut, VaryingAndCheapExpressionsAreKept) {
    for (const std::string map : {
             "float map(vec2 p) { return p.x * sin(p.y); }\n",                    // of the pixel
             "float map(vec2 p) { return p.x * (2.0 * iTime); }\n",               // costs next to nothing
             "float map(vec2 p) { float t = iTime; t += p.x; return sin(t); }\n", // changes
             "float map(vec2 p) { for (int i = 0; i < 3; i++) p += sin(float(i)); return p.x; }\n", // each
                                                                                                    // turn
             "float map(vec2 c) { return c.x; }\nfloat unused() { return sin(iTime); }\n",
         })
        EXPECT_EQ(once(marched(map)), "none") << map;
    const std::string map = "float map(vec2 p) { return p.x * sin(iTime); }\n";
    EXPECT_NE(once(marched(map)), "none");
    EXPECT_EQ(once(marched(map + "float first = map(vec2(1.0));\n")), "none") << "runs before mainImage";
    EXPECT_EQ(once(marched(map + "#ifdef TIDEMARK_HIT\nvoid mainHit() {}\n#endif\n")), "none")
        << "runs in place of mainImage";
    EXPECT_EQ(once("uniform float iTime, c;\nfloat map(vec2 p) { return p.x * sin(c); }\n" +
                   marched("").substr(marched("").find("void mainImage"))),
              "none")
        << "means a parameter there";
}

TEST(Cut, TheMostWorkComesFirst) {
    const std::string text = in_main("s += dear(u); for (int i = 0; i < 64; i++) s *= dear(s) + u;");
    const auto cuts = cuts_of(text).cuts;
    ASSERT_GT(cuts.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(cuts, std::greater<>(), &Cut::work));
    EXPECT_GT(cuts.front().work, 64 * cuts.back().work / 2) << "a loop counts as often as it turns";
}

/// Functions that are called before their definitions are found by their prototypes.
TEST(Cut, WorkGoesThroughPrototypes) {
    const std::string text =
        "float later(float x);\nout vec4 c; uniform float u;\nvoid main() { c.x = u + later(u); }\n"
        "float later(float x) { return u + exp(x) * sin(x) * cos(x); }\n";
    EXPECT_TRUE(std::ranges::any_of(cuts_of(text).cuts, [](const Cut& cut) {
        return cut.change.reason.find("exp(x)") != std::string::npos;
    }));
}

Cure replacing(const std::string& text, const std::string& words, const std::string& instead) {
    const auto read = parsed(text);
    for (NodeId id = 1; id < read->tree().nodes.size(); ++id)
        if (read->excerpt(id) == words && is_expression(read->tree()[id].kind)) {
            Wrap wrap = wrapped(*read, *written_for(*read, id, id), instead, "");
            wrap.replaces = true;
            return {{wrap}, "test"};
        }
    return {};
}

TEST(Cut, InnerCutsAreCoveredByOuterCuts) {
    const std::string text = "uniform float u;\nvoid main() { float s = (u * 2.0) + u; }\n";
    const Cure inner = replacing(text, "u * 2.0", "1.0"), outer = replacing(text, "(u * 2.0)", "3.0");
    const std::string wanted = "uniform float u;\nvoid main() { float s = 3.0 + u; }\n";
    EXPECT_EQ(with(text, {inner, outer}), wanted);
    EXPECT_EQ(with(text, {outer, inner}), wanted);
    EXPECT_EQ(with(text, {inner}), "uniform float u;\nvoid main() { float s = (1.0) + u; }\n");
    EXPECT_EQ(with(text, {outer, replacing(text, "(u * 2.0)", "4.0")}),
              "uniform float u;\nvoid main() { float s = 4.0 + u; }\n")
        << "of two for the same words the later one";
}

TEST(Cut, LinesKeepTheirNumbers) {
    const std::string text = in_main("\n\nif (u > 0.0) {\n s = dear(u);\n}\n s *= 2.0;\n");
    EXPECT_TRUE(makes(text, in_main("\n\n\n\n\n s *= 2.0;\n")));
}

TEST(Cut, CutsThatOverlapAreRefused) {
    const std::string text = in_main("s = dear(u) + dear(s);");
    std::vector<Cure> both;
    for (const Cut& cut : cuts_of(text).cuts)
        if (const std::string made = with(text, {cut.change});
            made == in_main("s =  dear(s);") || made == in_main("s = dear(u) ;"))
            both.push_back(cut.change);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(with(text, both), "refused") << "something has to stay";
}

/// Every text with one cut in its switched form, `k` being the switch and 7 its number.
std::vector<std::string> switched_texts_of(const std::string& text) {
    std::vector<std::string> texts;
    for (Cut cut : cuts_of(text).cuts) {
        if (cut.switched.empty())
            continue;
        for (Wrap& wrap : cut.switched)
            for (std::string* const part : {&wrap.front, &wrap.behind})
                for (const auto& [sign, with] : {std::pair("$", "k"), std::pair("@", "7")})
                    for (size_t at = part->find(sign); at != part->npos; at = part->find(sign))
                        part->replace(at, 1, with);
        texts.push_back(with(text, {{cut.switched, cut.change.reason}}));
    }
    return texts;
}

bool switches(const std::string& text, const std::string& switched) {
    return std::ranges::count(switched_texts_of(text), switched) == 1;
}

TEST(SwitchedCut, OperandsGetTheNeutralValueOfTheirType) {
    EXPECT_TRUE(switches(in_main("s = u + dear(u);"), in_main("s = u + (k ? float(0) : (dear(u)));")));
    EXPECT_TRUE(switches(in_main("s = dear(u) - u;"), in_main("s = (k ? float(0) : (dear(u))) - u;")));
    EXPECT_TRUE(switches(in_main("s = u * dear(u);"), in_main("s = u * (k ? float(1) : (dear(u)));")));
    EXPECT_TRUE(switches(in_main("vec2 v = vec2(u) + vec2(dear(u)); s = v.x;"),
                         in_main("vec2 v = vec2(u) + (k ? vec2(0) : (vec2(dear(u)))); s = v.x;")));
}

TEST(SwitchedCut, AnOperandThatTheTypeNeedsHasNoSwitch) {
    for (const std::string& text : switched_texts_of(in_main("vec2 v = u * vec2(dear(u)); s = v.x;")))
        EXPECT_EQ(text.find("u * (k"), std::string::npos) << text;
}

TEST(SwitchedCut, StatementsGetACondition) {
    EXPECT_TRUE(switches(in_main("s += dear(u);"), in_main("{ if (!k) s += dear(u); }")));
    EXPECT_TRUE(
        switches(in_main("if (u > 0.0) s += dear(u);"), in_main("if (u > 0.0) { if (!k) s += dear(u); }")));
}

TEST(SwitchedCut, ANumberBecomesAChoiceWithoutConst) {
    const std::string loop = "for (int i = 0; i < N; ++i) s += dear(s);";
    EXPECT_TRUE(switches("const int N = 64;\n" + in_main(loop), " int N = (k ? 32 : 64);\n" + in_main(loop)));
    EXPECT_TRUE(switches("#define N 64\n" + in_main(loop), "#define N (k ? 32 : 64)\n" + in_main(loop)));
    EXPECT_TRUE(
        switches(in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); if (d < 0.001) break; s += d; }"),
                 in_main("for (int i = 0; i < 64; ++i) { float d = dear(s); if (d < (k ? 0.01 : 0.001)) "
                         "break; s += d; }")));
}

TEST(SwitchedCut, MarchesGetExitsAndLongerSteps) {
    const std::string head = "for (int i = 0; i < 64; ++i) ";
    EXPECT_TRUE(switches(in_main(head + "{ s += dear(s); }"),
                         in_main(head + "{ { float tidemark_step7; s += (tidemark_step7 = dear(s)); if (k && "
                                        "abs(tidemark_step7) < 0.01) break; } }")));
    EXPECT_TRUE(switches(in_main(head + "{ s += dear(s); }"),
                         in_main(head + "{ { s += dear(s); if (k && s > 20.0) break; } }")));
    EXPECT_TRUE(switches(in_main(head + "{ s += dear(s); }"),
                         in_main(head + "{ s += (k ? 1.5 : 1.0) * (dear(s)); }")));
}

} // namespace tidemark::glsl::cut_test
