// Cures of what rounding, counting in floats and divergent neighbours do: which texts get one, and which
// none.
#include "glsl_support.hpp"
#include "shader/fixes.hpp"
#include "shader/tree_facts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::glsl::rounding_cures_test {

std::string with(const std::string& text, const std::vector<Cure>& cures) {
    return cured(text, "a.glsl", cures).value_or("refused");
}

std::string rewritten(const std::string& text) {
    const auto read = parsed(text);
    return with(text, rewrites(*read, find_facts(*read)));
}

/// Returns the cured expression; it uses floats x, y and vectors v, w of unknown values.
std::string expression(const std::string& words) {
    const std::string front = "float own(float x);\nfloat f(float x, float y, vec3 v, vec3 w) { return ";
    const std::string text = rewritten(front + words + "; }\n");
    return text.substr(front.size(), text.size() - front.size() - 4);
}

TEST(Rewrites, CancellingDifferencesAreRewritten) {
    EXPECT_EQ(expression("1.0 - cos(x)"), "(2.0 * sin(0.5 * x) * sin(0.5 * x))");
    EXPECT_EQ(expression("(1.0 - cos(x + y)) / x"), "(2.0 * sin(0.5 * (x + y)) * sin(0.5 * (x + y))) / x");
    EXPECT_EQ(expression("x * x - y * y"), "((x - y) * (x + y))");
    EXPECT_EQ(expression("1. - x*x"), "((1. - x) * (1. + x))");
    EXPECT_EQ(expression("dot(v, v) - dot(w, w)"), "(dot(v - w, v + w))");
    EXPECT_EQ(expression("sqrt(x) - sqrt(y)"), "((x - y) / (sqrt(x) + sqrt(y)))");
    EXPECT_EQ(expression("length(v) - length(w)"), "(dot(v - w, v + w) / (length(v) + length(w)))");
    EXPECT_EQ(expression("sin(x) - sin(y)"), "(2.0 * cos(0.5 * (x + y)) * sin(0.5 * (x - y)))");
    EXPECT_EQ(expression("cos(x) - cos(y)"), "(-2.0 * sin(0.5 * (x + y)) * sin(0.5 * (x - y)))");
    EXPECT_EQ(expression("acos(dot(v, w))"), "(2.0 * atan(length(v - w), length(v + w)))");
}

TEST(Rewrites, OtherExpressionsAreUnchanged) {
    for (const char* words :
         {"1.0 - sin(x)", "2.0 - cos(x)", "x * y - y * x", "x * x + y * y", "dot(v, v) - x * x",
          "dot(v, w) - dot(w, w)", "1.0 - dot(v, v)", "1.0 - 1.0", "sqrt(x) - length(v)", "1.0 - cos(own(x))",
          "acos(x)", "acos(clamp(dot(v, w), -1.0, 1.0))", "x++ * x++ - y * y"})
        EXPECT_EQ(expression(words), words);
}

TEST(Rewrites, AuthorFunctionsAreNotBuiltIns) {
    const std::string text = "float cos(float x) { return x; }\nfloat f(float x) { return 1.0 - cos(x); }\n";
    EXPECT_EQ(rewritten(text), text);
}

TEST(Rewrites, IntegersAreUnchanged) {
    const std::string text = "int f(int x, int y) { return x * x - y * y; }\n";
    EXPECT_EQ(rewritten(text), text);
}

const std::string k_sphere =
    "float f(vec3 o, vec3 d, float r) { float b = dot(o, d); float c = dot(o, o) - r * r; ";

TEST(Rewrites, ASpheresDiscriminant) {
    EXPECT_EQ(rewritten(k_sphere + "return b * b - c; }\n"),
              k_sphere + "return ((r * r) - dot(o - b * d, o - b * d)); }\n");
    // A variable that was changed in between is another number.
    EXPECT_EQ(rewritten(k_sphere + "c += 1.0; return b * b - c; }\n"),
              k_sphere + "c += 1.0; return b * b - c; }\n");
}

/// Returns the one value of the first `name` after "return".
std::string value_of(const std::string& text) {
    const auto read = parsed(text);
    const SyntaxTree& tree = read->tree();
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (tree[id].kind == NodeKind::name && tree[tree[id].parent].kind == NodeKind::return_statement) {
            const NodeId value = SingleValues(*read, find_facts(*read)).of(id);
            return value == k_no_node ? "" : read->excerpt(value);
        }
    return "no name";
}

TEST(SingleValues, IsTheInitialiser) {
    EXPECT_EQ(value_of("float f() { float a = 1.0; return a; }"), "1.0");
    EXPECT_EQ(value_of("float a = 2.0; float f() { return a; }"), "2.0");
    EXPECT_EQ(value_of("float g() { float a = 3.0; return 1.0; } float f() { float a = 4.0; return a; }"),
              "4.0");
}

TEST(SingleValues, IsMissingForVariablesThatChange) {
    EXPECT_EQ(value_of("float f(float a) { return a; }"), "");
    EXPECT_EQ(value_of("float f() { float a; a = 1.0; return a; }"), "");
    EXPECT_EQ(value_of("float f() { float a = 1.0; a *= 2.0; return a; }"), "");
    EXPECT_EQ(value_of("float f() { float a = 1.0; a++; return a; }"), "");
    EXPECT_EQ(value_of("void g(inout float x) { x = 1.0; } float f() { float a = 1.0; g(a); return a; }"),
              "");
    EXPECT_EQ(value_of("float a = 1.0; void g() { a = 2.0; } float f() { return a; }"), "");
    EXPECT_EQ(value_of("float f() { float a = 1.0; { float a = 2.0; } return a; }"), "");
}

std::string reduced(const std::string& text) {
    const auto read = parsed(text);
    return with(text, reduced_times(*read, find_facts(*read)));
}

const std::string k_front = "uniform float iTime;\n";

std::string phases(const std::string& body) {
    const std::string text = reduced(k_front + "float f(float x) { " + body + " }\n");
    const size_t at = text.find("float f(");
    EXPECT_NE(at, text.npos) << text;
    return at == text.npos ? text : text.substr(at + 19, text.size() - at - 22);
}

TEST(ReducedTime, IsAFractionOfAPeriod) {
    EXPECT_EQ(phases("return fract(x + 7.0 * iTime);"),
              "return fract(x + 1.0 * turns_of_time(vec3(7, 0, 0)));");
    EXPECT_EQ(phases("return fract((iTime - x) * 0.5);"),
              "return fract((2.0 * turns_of_time(vec3(0.5, 0, 0)) - x) * 0.5);");
    EXPECT_EQ(phases("return mod(iTime * 3.0, 6.0);"),
              "return mod(6.0 * turns_of_time(vec3(0.5, 0, 0)), 6.0);");
    EXPECT_EQ(phases("float t = iTime / 4.0; return fract(t * 2.0);"),
              "float t = iTime / 4.0; return fract(1.0 * turns_of_time(vec3(0.5, 0, 0)));");
    // 1 / (2 pi) = 0.15917968750 - 0.00002474338 - 0.00000000103, in parts of 12 bits.
    EXPECT_EQ(phases("return sin(x + iTime);"),
              "return sin(x + 6.283185307179586 * turns_of_time(vec3(0.1591796875, -2.4743378162384033e-05, "
              "-1.0300027497578412e-09)));");
}

TEST(ReducedTime, IsUnchangedWhereTimeIsNotAPhase) {
    for (const std::string body :
         {"return x + iTime;", "return sin(x * iTime);", "return fract(x);",
          "float t = iTime; t += 1.0; return sin(t);", "return mod(iTime, x);", "return sin(sqrt(iTime));",
          "return mod(iTime, 2.0 / 0.0);", "return sin(1e30 * iTime * 1e30);", "return sin(iTime / 1e-320);",
          "return sin(0.0 * iTime);", "return sin(x + 0.0 * (iTime + x));",
          "return mod(iTime, 1e300 * 1e300);"})
        EXPECT_EQ(phases(body), body);
}

TEST(ReducedTime, TwoWholeNumbersAreDividedAsInts) {
    const std::string body = "const int N = 3; return sin(2 / 3 * iTime) + mod(iTime, 7 / N * 2.0);";
    EXPECT_EQ(phases(body), body);
    EXPECT_EQ(phases("return fract(x + 3 / 2.0 * iTime);"),
              "return fract(x + 1.0 * turns_of_time(vec3(1.5, 0, 0)));");
}

TEST(ReducedTime, FunctionIsAddedOnceWithItsDeclarations) {
    const std::string text = reduced(k_front + "float f() { return sin(iTime) + cos(2.0 * iTime); }\n");
    EXPECT_EQ(count(text, "uniform float iTimeLow;"), 1);
    EXPECT_EQ(count(text, "float turns_of_time(vec3 rate)"), 1);
    EXPECT_EQ(count(text, "turns_of_time("), 3);
    const std::string declared = k_front + "uniform float iTimeLow;\nfloat f() { return sin(iTime); }\n";
    EXPECT_EQ(count(reduced(declared), "uniform float iTimeLow;"), 1);
    const std::string taken = k_front + "float turns_of_time;\nfloat f() { return sin(iTime); }\n";
    EXPECT_EQ(count(reduced(taken), "turns_of_time2("), 2);
}

TEST(ReducedTime, MacrosAreUnchanged) {
    const std::string text = k_front + "#define T iTime\nfloat f() { return sin(T) + T; }\n";
    EXPECT_EQ(reduced(text), text);
}

struct Counted {
    double turns, exact;
};

std::vector<Counted> miscounted(const std::string& loop) {
    const auto read =
        parsed("void g(out float x) { x = 1.0; }\nfloat f(float s) { " + loop + " return s; }\n");
    std::vector<Counted> found;
    for (const FloatCounter& each : miscounting_loops(*read, find_facts(*read)))
        found.push_back({each.turns, each.exact_turns});
    return found;
}

TEST(FloatCounter, WrongIterationCountsAreFound) {
    const auto more = miscounted("for (float x = 0.0; x < 1.0; x += 0.01) s += x;");
    ASSERT_EQ(more.size(), 1U);
    EXPECT_EQ(more[0].turns, 101);
    EXPECT_EQ(more[0].exact, 100);
    const auto less = miscounted("for (float x = 0.0; x <= 1.0; x += 0.1) s += x;");
    ASSERT_EQ(less.size(), 1U);
    EXPECT_EQ(less[0].turns, 10);
    EXPECT_EQ(less[0].exact, 11);
    const auto down = miscounted("for (float x = 1.0; x > -1.0; x -= 0.02) s += x;");
    ASSERT_EQ(down.size(), 1U);
    EXPECT_EQ(down[0].exact, 100);
    const auto endless = miscounted("for (float x = 16777216.0; x < 16777226.0; x += 1.0) s += x;");
    ASSERT_EQ(endless.size(), 1U);
    EXPECT_TRUE(std::isinf(endless[0].turns));
    EXPECT_EQ(endless[0].exact, 10);
}

TEST(FloatCounter, CorrectIterationCountsPass) {
    for (const char* loop :
         {"for (float x = 0.0; x < 1.0; x += 0.1) s += x;", // ten, as it says
          "for (float x = 0.0; x < 64.0; x += 1.0) s += x;",
          "for (float x = 0.0; x < 1.0; x += 0.125) s += x;", "for (int x = 0; x < 100; x += 1) s += 1.0;",
          "for (float x = 0.0; x < 1.0; x += 0.3) s += x;", "for (float x = 0.0; x < s; x += 0.01) s += x;",
          "for (float x = 0.0; x < 1.0; x += 0.01) x += 0.01;",
          "for (float x = 0.0; x < 1.0; x += 0.01) g(x);", "for (float x = 0.0; x > 1.0; x += 0.01) s += x;"})
        EXPECT_TRUE(miscounted(loop).empty()) << loop;
}

std::string counted_whole(const std::string& text) {
    const auto read = parsed(text);
    std::vector<Cure> cures;
    for (const FloatCounter& each : miscounting_loops(*read, find_facts(*read)))
        if (auto cure = whole_counter(*read, each))
            cures.push_back(*std::move(cure));
    return with(text, cures);
}

TEST(FloatCounter, BecomesAnIntegerCounter) {
    EXPECT_EQ(
        counted_whole("float f(float s) { for (float x = -0.5; x < 0.5; x += 0.01) s += x; return s; }\n"),
        "float f(float s) { for (int x_turn = 0; x_turn < 100; ++x_turn) { float x = -0.5 + 0.01 * "
        "float(x_turn); s += x; } return s; }\n");
    EXPECT_EQ(
        counted_whole("float f(float s) { for (float x = 1.0; x >= 0.0; x -= 0.1) { s += x; } return s; }\n"),
        "float f(float s) { for (int x_turn = 0; x_turn < 11; ++x_turn) { float x = 1.0 - 0.1 * "
        "float(x_turn); { s += x; } } return s; }\n");
}

using Proposal = std::optional<Cure> (*)(const ParsedText&, const TreeFacts&, const Divergent&);

/// Returns the text with the proposal for its first derivative; `gl_FragCoord` separates neighbouring pixels.
std::string divergent_cured(const std::string& body, Proposal propose) {
    const std::string front =
        "uniform sampler2D iChannel0;\nout vec4 c;\nvoid main() { vec2 p = gl_FragCoord.xy; ";
    const std::string text = front + body + " }\n";
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    std::vector<Cure> cures;
    for (const Divergent& each : find_divergent(*read, facts, [](std::string_view) { return true; }))
        if (auto cure = propose(*read, facts, each))
            cures.push_back(*std::move(cure));
    const std::string result = with(text, cures);
    return result.starts_with(front) ? result.substr(front.size(), result.size() - front.size() - 3) : result;
}

std::string hoisted(const std::string& body) {
    return divergent_cured(body, hoisted_derivative);
}

TEST(HoistedDerivative, IsMovedBeforeTheBranch) {
    EXPECT_EQ(hoisted("if (p.x > 9.0) c = texture(iChannel0, p * 0.1);"),
              "vec4 taken_before = texture(iChannel0, p * 0.1); if (p.x > 9.0) c = taken_before;");
    EXPECT_EQ(hoisted("float w = 1.0; if (p.x > 9.0) { if (p.y > 1.0) w = fwidth(p.x * 2.0); }"),
              "float w = 1.0; float taken_before = fwidth(p.x * 2.0); if (p.x > 9.0) { if (p.y > 1.0) w = "
              "taken_before; }");
    EXPECT_EQ(hoisted("if (p.x > 9.0) return; c.xy = dFdx(p);"),
              "vec2 taken_before = dFdx(p); if (p.x > 9.0) return; c.xy = taken_before;");
}

TEST(HoistedDerivative, IsKeptIfItsArgumentsChangeInBetween) {
    for (const std::string body : {"if (p.x > 9.0) { vec2 q = p; c = texture(iChannel0, q); }",
                                   "if (p.x > 9.0) { p *= 2.0; c = texture(iChannel0, p); }",
                                   "if (p.x > 9.0) return; p += 1.0; c = texture(iChannel0, p);",
                                   "if (p.x > 9.0) c = texture(iChannel0, p++);"})
        EXPECT_EQ(hoisted(body), body);
}

TEST(BaseLevel, ReplacesTheImplicitLevel) {
    EXPECT_EQ(divergent_cured("if (p.x > 9.0) { vec2 q = p; c = texture(iChannel0, q * 0.1); }", base_level),
              "if (p.x > 9.0) { vec2 q = p; c = textureLod(iChannel0, q * 0.1, 0.0); }");
    EXPECT_EQ(divergent_cured("if (p.x > 9.0) c = texture( iChannel0, p, -100.0 ).yxyx;", base_level),
              "if (p.x > 9.0) c = textureLod( iChannel0, p, 0.0 ).yxyx;");
    const std::string derivative = "if (p.x > 9.0) c.x = dFdx(p.x);";
    EXPECT_EQ(divergent_cured(derivative, base_level), derivative);
}

} // namespace tidemark::glsl::rounding_cures_test
