// Sums with one rounding, and from the other end: the numbers that a driver makes of the rewritten text.
#include "variation_test.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace tidemark::lab::variation_gl_test {

using glsl::Variation;

/// Numbers that no compiler knows: made of iFrame, which is 0.
constexpr const char* k_numbers = "#define A (1.1 + float(iFrame))\n#define B (1.3 + float(iFrame))\n"
                                  "#define C (-1.43 - float(iFrame))\n";

/// The lines of a text that a variation changes, if it may change those above line 3 only.
TEST_F(VariationTest, OnlyTheChosenPlacesChange) {
    render::Renderer drawing =
        renderer(std::string("void mainImage(out vec4 c, in vec2 p) {\nc = vec4(sin(p.x));\n"
                             "c += vec4(sin(p.y), cos(p.x), 0.0, 0.0);\n}\n"),
                 {8, 8});
    const auto text = read_text(drawing, 0);
    ASSERT_TRUE(text);
    const auto line_of = [&](glsl::NodeId id) { return (*text)->spelled((*text)->tree()[id].word).line; };
    const auto lines = [&](const glsl::MayVary& may) {
        std::vector<int> found;
        for (const glsl::NodeId id : glsl::vary_sines(**text, glsl::find_facts(**text), may).places)
            found.push_back(line_of(id));
        return found;
    };
    EXPECT_EQ(lines({}), (std::vector{2, 3, 3}));
    EXPECT_EQ(lines([&](glsl::NodeId id) { return line_of(id) < 3; }), (std::vector{2}));
}

TEST_F(VariationTest, AFusedMultiplyAddIsExact) {
    const float a = 1.1f, b = 1.3f, c = -1.43f, ab = a * b;
    const std::vector<std::string> expressions = {
        "A * B + C",
        "C + A * B",
        "A * A - A * A",
        "C - A * B",
        "A * B - C",
        "(vec2(A) * B + C).y",
        "(C - vec3(A) * B).z",
        "(vec4(C) + B * vec4(A)).w",
        "(mat2(A) * vec2(B) + C).x",
        "float(3 * iFrame + 2) * A + C",
    };
    const std::vector<float> rounded = varied(glsl::vary_contraction, 0, expressions, k_numbers);
    const std::vector<float> whole = varied(glsl::vary_contraction, 1, expressions, k_numbers);
    const float once = std::fma(a, b, c);
    ASSERT_NE(once, ab + c) << "numbers for which it matters";
    const float error = std::fma(a, a, -(a * a));
    ASSERT_NE(error, 0.0f);
    EXPECT_EQ(rounded, (std::vector<float>{ab + c, ab + c, 0.0f, c - ab, ab - c, ab + c, c - ab, ab + c,
                                           ab + c, 2.0f * a + c}));
    EXPECT_EQ(whole, (std::vector<float>{once, once, error, std::fma(-a, b, c), std::fma(a, b, -c), once,
                                         std::fma(-a, b, c), once, ab + c, std::fma(2.0f, a, c)}));
}

TEST_F(VariationTest, ASumIsAddedInReverseOrder) {
    const float a = 1.1f, b = 1.3f, c = -1.43f;
    const std::vector<float> found =
        varied(glsl::vary_order, 0, {"A + B + C", "A - B - C + A", "(vec2(A) - B + C).y"}, k_numbers);
    ASSERT_NE((a + b) + c, a + (b + c));
    EXPECT_EQ(found, (std::vector<float>{a + (b + c), a - (b + (c - a)), a - (b - c)}));
}

/// Between 1e8 and -1e8 a one is lost. No compiler knows that the two are each other's negative.
TEST_F(VariationTest, DotProductsAreSummedFromEitherEnd) {
    const std::string before = "#define BIG (1e8 + float(iFrame))\n#define LOW (float(iFrame) * 3.0 - "
                               "1e8)\n#define ONE (1.0 + float(iFrame))\n"
                               "#define V vec3(BIG, LOW, ONE)\n#define W vec4(BIG, LOW, ONE, ONE)\n";
    const std::vector<std::string> expressions = {
        "dot(V, vec3(ONE))",
        "dot(W, vec4(ONE))",
        "(V * mat3(vec3(0.0), vec3(ONE), vec3(0.0))).y",
        "dot(reflect(vec3(ONE), V).xy, vec2(ONE, 0.0))", // 1 - 2 * dot * 1e8
        "length(vec3(3.0, 4.0, 12.0) * ONE)",
        "distance(vec3(3.0, 4.0, 12.0) * ONE, vec3(0.0))",
        "normalize(vec3(2.0, 3.0, 6.0) * ONE).z",
        "refract(vec3(0.0, -0.6, -0.8) * ONE, vec3(0.0, 0.0, 1.0), 1.0).y",
    };
    for (const auto& [mode, three, four, reflected] :
         {std::tuple(1, 1.0f, 2.0f, -2e8f), std::tuple(2, 0.0f, 0.0f, 1.0f)}) {
        const std::vector<float> found = varied(glsl::vary_formulas, mode, expressions, before);
        EXPECT_EQ(std::vector(found.begin(), found.begin() + 6),
                  (std::vector{three, four, three, reflected, 13.0f, 13.0f}))
            << mode;
        EXPECT_NEAR(found[6], 6.0 / 7, 1e-6) << mode;
        EXPECT_NEAR(found[7], -0.6, 1e-6) << mode;
    }
}

TEST_F(VariationTest, APowerOfAHalfIsARoot) {
    const std::string before = "#define X (7.3 + float(iFrame))\n";
    const std::vector<float> found =
        varied(glsl::vary_formulas, 4, {"pow(X, 0.5)", "pow(vec2(X), vec2(2.0, 0.5)).y"}, before);
    EXPECT_EQ(found, (std::vector<float>(2, std::sqrt(7.3f))));
}

/// An expression in X, and the bits that Chromium 156 computed of it with SwiftShader for three numbers.
struct OfSwiftShader {
    const char* expression;
    std::array<uint32_t, 3> bits;
};
constexpr std::array k_of_swiftshader = {
    OfSwiftShader{"sin(X * 9.0)", {0x3F314010, 0xBF7EE490, 0x3EC9D407}},
    OfSwiftShader{"cos(X * 9.0)", {0xBF38BBD8, 0xBDBAC26D, 0xBF6B4060}},
    OfSwiftShader{"tan(X)", {0xBDAE70DA, 0xBF9BBA5D, 0xBF6B3C4D}},
    OfSwiftShader{"atan(X)", {0xBFA297C8, 0xBF39261A, 0x3F967FC3}},
    OfSwiftShader{"atan(X, 1.7)", {0xBF8AFE19, 0xBEF53B76, 0x3F7445F0}},
    OfSwiftShader{"atan(X, -1.7)", {0xC00390CE, 0xC02A686C, 0x400BFE5F}},
    OfSwiftShader{"asin(X / 8.0)", {0xBED48D8E, 0xBDE27612, 0x3E9BE5D7}},
    OfSwiftShader{"acos(X / 8.0)", {0x3FFE34B8, 0x3FD73538, 0x3FA21618}},
    OfSwiftShader{"exp2(X)", {0x3DDACB94, 0x3F0AD4C7, 0x40A8B6D6}},
    OfSwiftShader{"exp(X)", {0x3D2295DF, 0x3ED3C5BC, 0x41301872}},
    OfSwiftShader{"log2(abs(X))", {0x3FD851DA, 0xBE382304, 0x3FA18C52}},
    OfSwiftShader{"log(abs(X))", {0x3F95F100, 0xBDFF448D, 0x3F5FF409}},
    OfSwiftShader{"pow(abs(X), 1.7)", {0x40EA6D62, 0x3F4F1E06, 0x408D96AE}},
    OfSwiftShader{"pow(-abs(X), 1.7)", {0x40EA6D62, 0x3F4F1E06, 0x408D96AE}},
    OfSwiftShader{"log(-abs(X))", {0x3F95F100, 0xBDFF448D, 0x3F5FF409}},
    OfSwiftShader{"tanh(X)", {0xBF7F31CF, 0xBF35340C, 0x3F7BCECD}},
    OfSwiftShader{"sin(X * 12345.0)", {0xBEAAFEF2, 0x3E09CB07, 0x3F37C951}},
    OfSwiftShader{"X / 1.7", {0xBFF2F0F0, 0xBF04F0F0, 0x3FB49696}},
    OfSwiftShader{"smoothstep(-3.0, 3.0, X)", {0x00000000, 0x3E924302, 0x3F78CBC4}},
    OfSwiftShader{"mix(X, 1.3, X * 0.3)", {0xC0F375D5, 0xBFBAFF52, 0x3FCDD57A}},
    OfSwiftShader{"dot(V, W)", {0x40818EA5, 0x408404A6, 0xBFA6E568}},
    OfSwiftShader{"(M * V).y", {0xC2F3ED2F, 0xC09E2AAE, 0x422A237D}},
    OfSwiftShader{"(V * M).y", {0xC2E28C62, 0xC0163BC2, 0x42406A36}},
    OfSwiftShader{"normalize(V).y", {0x3F63FBD0, 0x3EB3AED5, 0x3F668D6F}},
    OfSwiftShader{"length(V)", {0x413B0A74, 0x400E20CD, 0x40CC65ED}},
    OfSwiftShader{"reflect(V, W).y", {0x4097C333, 0xC09FE2CF, 0x40F27E64}},
    OfSwiftShader{"determinant(M)", {0x436D06CB, 0x41B1AB3C, 0x42B36AC2}},
    OfSwiftShader{"inverse(M)[1].y", {0xBE017EE6, 0xBF097DA6, 0x3E183FE1}},
    OfSwiftShader{"inverse(M)[2].x", {0x3D1481AB, 0x3E4BD135, 0xBDBF2E4E}},
    OfSwiftShader{"determinant(N)", {0x44773A81, 0x431769E1, 0x4337FE02}},
    OfSwiftShader{"inverse(N)[1].z", {0x3D0F6B2A, 0x3D4F6669, 0x3DBA81B5}},
    OfSwiftShader{"inverse(N)[3].x", {0x3E1D912F, 0x3E88353A, 0xBEDCC71A}},
    OfSwiftShader{"asinh(X)", {0xBFF1A205, 0xBF4BC913, 0x3FCDEE5C}},
    OfSwiftShader{"acosh(abs(X) + 1.0)", {0x4007B1FC, 0x3F9F8CFA, 0x3FF27127}},
    OfSwiftShader{"atanh(X / 8.0)", {0xBEDAEF6D, 0xBDE2EC97, 0x3E9E5D38}},
    OfSwiftShader{"refract(normalize(V), normalize(W), 0.7).y", {0x3E03711A, 0xBDBF50D6, 0x3F0C3B2F}},
    OfSwiftShader{"refract(normalize(V), normalize(W), 1.9).y", {0, 0, 0}},
};

TEST_F(VariationTest, FunctionsAreSwiftShadersBitForBit) {
    const auto vary = [](const glsl::ParsedText& text, const glsl::TreeFacts& facts,
                         const glsl::MayVary& may) {
        return glsl::vary_like_swiftshader(text, facts, 127, {}, may);
    };
    const std::array numbers = {"-3.2265625", "-0.8828125", "2.3984375"};
    std::vector<std::string> expressions;
    for (const OfSwiftShader& each : k_of_swiftshader)
        expressions.emplace_back(each.expression);
    for (size_t i = 0; i < numbers.size(); ++i) {
        const std::string before = fmt::format(
            "#define X ({} + float(iFrame))\n"
            "#define V vec3(X, X * X, 1.0 - X)\n"
            "#define W vec3(1.1, 0.7, X + 3.3)\n"
            "#define M mat3(X, 1.3, 2.7, abs(X), X * 3.1, 0.3, 1.9, X, 7.7)\n"
            "#define N mat4(X, 1.3, 2.7, 0.9, abs(X), X * 3.1, 0.3, 0.4, 1.9, X, 7.7, -2.1, 1.7, 0.6, "
            "X * 0.3, 3.3)\n",
            numbers[i]);
        const std::vector<float> found = varied(vary, 31, expressions, before);
        const std::vector<float> own = varied(vary, 0, expressions, before);
        size_t unlike = 0;
        for (size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(std::bit_cast<uint32_t>(found[k]), k_of_swiftshader[k].bits[i])
                << expressions[k] << ", X = " << numbers[i];
            unlike += std::bit_cast<uint32_t>(own[k]) != k_of_swiftshader[k].bits[i];
        }
        EXPECT_GT(unlike, 12u) << "this driver's functions are other ones";
    }
}

/// Operators and conversions that GLSL leaves undefined, with the values that Chromium 156 computed of them
/// with SwiftShader at run time.
TEST_F(VariationTest, UndefinedOperationsAreSwiftShaders) {
    const auto vary = [](const glsl::ParsedText& text, const glsl::TreeFacts& facts,
                         const glsl::MayVary& may) {
        return glsl::vary_like_swiftshader(text, facts, 127, {}, may);
    };
    const std::string before = "#define Z iFrame\n#define O (1.0 + float(iFrame))\n"
                               "int count[3] = int[3](10, 11, 12);\n"
                               "float nan() { float zero = float(iFrame); return zero / zero; }\n";
    const std::vector<std::pair<std::string, float>> known = {
        {"float((Z - 7) % (Z + 3))", 2},
        {"float((Z - 7) % (Z - 3))", -1},
        {"float((Z + 7) % (Z - 3))", -2},
        {"float((Z + 7) % Z)", 0},
        {"float((ivec2(Z - 7) % 3).y)", 2},
        {"float((Z + 7) / Z)", -7},
        {"float((Z - 7) / Z)", 7},
        {"float((Z - 2147483647 - 1) / (Z - 1))", 1},
        {"float(uint(Z + 7) % uint(Z))", 7},
        {"float(uint(Z + 7) / uint(Z))", 0},
        {"float(uint(-2.5 * O))", 0},
        {"float(uint(1e20 * O))", 0},
        {"float(uvec2(-2.5 * vec2(O)).y)", 0},
        {"float(count[Z - 2])", 10},
        {"float(count[Z + 5])", 12},
        {"float(count[(Z + 5) % 7])", 12},
        {"float(count[Z - 2 >> 1])", 10},
        {"max(nan(), 0.5 * O)", 0.5f},
        {"float(floatBitsToInt(max(0.5 * O, nan())) & 0x7fffffff)", 2143289344.0f}, // NaN
        {"float(floatBitsToInt(min(0.5 * O, nan())) & 0x7fffffff)", 2143289344.0f}, // NaN
    };
    std::vector<std::string> expressions;
    for (const auto& [expression, value] : known)
        expressions.push_back(expression);
    const std::vector<float> found = varied(vary, int(glsl::SwiftShaderPart::outside), expressions, before);
    for (size_t i = 0; i < known.size(); ++i)
        EXPECT_EQ(found[i], known[i].second) << expressions[i];
    size_t unlike = 0;
    const std::vector<float> own = varied(vary, 0, expressions, before);
    for (size_t i = 0; i < known.size(); ++i)
        unlike += own[i] != known[i].second;
    EXPECT_GT(unlike, 9u) << "this driver's values are other ones";
}

/// A block of 2x2 pixels has one derivative: the numbers of dFdx(v), dFdy(w).y and fwidth(v) that Chromium
/// 156 computed with SwiftShader in the four blocks of a picture of 4x4.
TEST_F(VariationTest, DerivativesAreSwiftShaders) {
    const std::array<std::array<float, 3>, 4> blocks = {{{0.53125f, 0.265625f, 0.65625f},
                                                         {1.53125f, 2.578125f, 2.15625f},
                                                         {1.28125f, 1.765625f, 1.65625f},
                                                         {2.28125f, 10.078125f, 4.15625f}}};
    render::Renderer drawing =
        renderer("void mainImage(out vec4 c, in vec2 p) {\n"
                 "    float v = p.x * p.x * 0.25 + p.y * p.y * p.x * 0.125;\n"
                 "    vec2 w = vec2(v, v * p.y);\n    c = vec4(dFdx(v), dFdy(w).y, fwidth(v), 1.0);\n}\n",
                 {4, 4});
    const auto text = read_text(drawing, 0);
    ASSERT_TRUE(text);
    const Variation made = like_swiftshader(**text, glsl::find_facts(**text), {});
    EXPECT_EQ(made.places.size(), 3u);
    const PassPreview preview(drawing, 0, {});
    auto stand_in = StandIn::link(preview, made.text, "a variation");
    ASSERT_TRUE(stand_in) << to_string(stand_in.error());
    const auto unlike = [&](int mode) {
        stand_in->set(made.mode_uniform, mode);
        stand_in->draw(preview);
        const image::Image picture = stand_in->picture();
        int count = 0;
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x)
                for (size_t k = 0; k < 3; ++k)
                    count += picture.f32()[size_t(4 * y + x) * 4 + k] != blocks[size_t(y / 2 * 2 + x / 2)][k];
        return count;
    };
    EXPECT_EQ(unlike(int(glsl::SwiftShaderPart::derivatives)), 0);
    EXPECT_GT(unlike(0), 12) << "this driver has other derivatives";
}

/// In SwiftShader `fwidth` of equal values is -0, so a quotient by it has the opposite sign. The sum of the
/// two derivatives' magnitudes is +0 there, too.
TEST_F(VariationTest, AWidthOfZeroIsNegativeInSwiftShader) {
    const std::vector<float> found =
        varied(like_swiftshader, int(glsl::SwiftShaderPart::derivatives),
               {"1.0 / fwidth(O)", "1.0 / (abs(dFdx(O)) + abs(dFdy(O)))"}, "#define O float(iFrame)\n");
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(found, (std::vector<float>{-infinity, infinity}));
}

/// A pixel that has left a loop takes part in the derivatives of its neighbours with what its variables were
/// at the beginning of its last iteration: Chromium 156's numbers in a picture of 4x4. Members of a structure
/// are such variables.
TEST_F(VariationTest, PixelsThatLeftALoopKeepItsVariables) {
    const std::array<float, 16> known = {
        12.11328125f, 4.6875f, 5.6875f,  2.03125f, 12.11328125f, 2.1875f, 2.03125f, 2.03125f,
        11.21484375f, 3.9375f, 2.65625f, 0.53125f, 8.4375f,      3.9375f, 2.65625f, 0.53125f};
    const std::string loop = "    for (int i = 0; i < 6 + iFrame; ++i) {\n        V += 0.25 * p.x;\n"
                             "        if (V > 2.0) break;\n        V += 0.125 * p.y;\n"
                             "        S += dFdx(V * V);\n    }\n    c = vec4(S);\n}\n";
    for (const char* const before :
         {"#define V v\n#define S s\nvoid mainImage(out vec4 c, in vec2 p) {\n    float v = 0.0, s = 0.0;\n",
          "#define V r.v\n#define S r.sums.x\nstruct R { vec2 sums; float v; };\n"
          "void mainImage(out vec4 c, in vec2 p) {\n    R r = R(vec2(0.0), 0.0);\n"}) {
        render::Renderer drawing = renderer(std::string(before) + loop, {4, 4});
        const auto text = read_text(drawing, 0);
        ASSERT_TRUE(text);
        const Variation made = like_swiftshader(**text, glsl::find_facts(**text), {});
        const PassPreview preview(drawing, 0, {});
        auto stand_in = StandIn::link(preview, made.text, "a variation");
        ASSERT_TRUE(stand_in) << to_string(stand_in.error());
        stand_in->set(made.mode_uniform, k_all_parts);
        stand_in->draw(preview);
        const image::Image picture = stand_in->picture();
        for (size_t i = 0; i < known.size(); ++i)
            EXPECT_EQ(picture.f32()[4 * i], known[i]) << i << " of " << before;
    }
}

/// Chromium's compilers compute what they know as exactly as others do, through functions and variables, but
/// not through loops, nor a part of a vector. The numbers are Chromium's; SwiftShader's own sine gives 0.957.
TEST_F(VariationTest, KnownValuesAreNotSwiftShaders) {
    const std::string before =
        "#define O float(iFrame)\n"
        "float f(float x) { return sin(x); }\nfloat g(float x) { return sin(x); }\n"
        "const float b = 4.0;\nfloat hash(float x) { return fract(x * 43758.5453); }\n"
        "float turned(float a) { float t = 0.0; return sin(a + t * 2.0); }\n"
        "float set(float a) { float x = a; x = 12.0; return sin(x); }\n"
        "float looped() { float s = 0.0; for (int i = 4; i < 5; ++i) s += sin(float(i) * 3.0); return s; }\n"
        "float after() { float x = 2.0; for (int i = 0; i < 2; ++i) x += 5.0; return sin(x); }\n"
        "float chosen(float a) { float x = 12.0; if (a > 1.0) x = 24.0; return sin(x); }\n";
    for (const auto& [expressions, expected] :
         {std::pair(std::vector<std::string>{"sin(12.0)", "f(b * 3.0)", "turned(12.0)", "set(O)"},
                    0.34765625f),
          {{"g(12.0 + O)", "g(12.0 - O)", "turned(12.0 + O)", "looped()", "after()", "chosen(O)",
            "sin(vec2(12.0, O)).x"},
           0.95703125f}})
        for (const std::string& expression : expressions)
            EXPECT_EQ(varied(like_swiftshader, 1, {"hash(" + expression + ")"}, before)[0], expected)
                << expression;
}

/// The bits are Chromium 156's. llvmpipe's arcs of constants are up to 8e-5 off, which `cos` of them shows,
/// too; its other functions have another last bit.
TEST_F(VariationTest, FunctionsOfConstantsAreChromiums) {
    const std::vector<std::pair<std::string, uint32_t>> known = {
        {"acos(sqrt(5.0) / 3.0)", 0x3F3ACF6E},
        {"acos(-0.4)", 0x3FFDBC70},
        {"asin(0.3)", 0x3E9C00AD},
        {"atan(2.0)", 0x3F8DB70D},
        {"atan(2.0, -3.0)", 0x40236E05},
        {"atan(0.4)", 0x3EC2D1BC},
        {"tan(0.3)", 0x3E9E6153},
        {"normalize(vec3(0.1, 0.2, 0.3)).x", 0x3E88D676},
        {"normalize(vec2(-1.0, 0.7)).y", 0x3F12CE6D}};
    for (const auto& [expression, bits] : known)
        EXPECT_EQ(std::bit_cast<uint32_t>(varied(like_swiftshader, 2, {expression}, "")[0]), bits)
            << expression;
    const std::vector<float> wave = varied(
        like_swiftshader, 3, {"fract(43758.5 * cos(acos(0.3)))", "fract(43758.5 * cos(acos(0.3) + B))"},
        "#define B float(iFrame)\n");
    EXPECT_EQ(wave, (std::vector{0.551757812f, 0.470703125f}));
}

/// Chromium 156 adds the known numbers to each other first, but only along one path. The bits are its own.
TEST_F(VariationTest, KnownStepsOfAVariableAreAddedUp) {
    const std::string before =
        "#define A (1.3 * (1.0 + float(iFrame)))\n#define B (-1.7 * (1.0 + float(iFrame)))\n"
        "float stepped(float x) { x += 0.1; x += 0.1; x += 0.1; return x; }\n"
        "float parted(float x) { x += 0.1; if (x < 100.0) x += 0.1; x += 0.1; return x; }\n"
        "float one(inout float x) { return x += 0.1; }\n"
        "float called(float x) { one(x); one(x); one(x); return x; }\n"
        "float turns(float x) { x += 0.1; for (int i = 0; i < 3 + iFrame; ++i) x += 0.1; return x; }\n"
        "float back(float x) { x -= 0.1; x += 0.7; x -= 0.3; return x; }\n"
        "float held(float x) { x += 0.1; x *= 1.5; x += 0.1; return x; }\n";
    const std::vector<std::pair<std::string, uint32_t>> known = {
        {"stepped(A)", 0x3FCCCCCC}, {"called(A)", 0x3FCCCCCC}, {"back(A)", 0x3FCCCCCC},
        {"parted(A)", 0x3FCCCCCD},  {"turns(A)", 0x3FD9999A},  {"stepped(B)", 0xBFB33334},
        {"called(B)", 0xBFB33334},  {"back(B)", 0xBFB33334},   {"parted(B)", 0xBFB33333},
        {"turns(B)", 0xBFA66666},   {"held(A)", 0x400CCCCC},   {"held(B)", 0xC0133334}};
    std::vector<std::string> expressions;
    for (const auto& [expression, bits] : known)
        expressions.push_back(expression);
    const std::vector<float> found = varied(like_its_compiler, k_all_parts, expressions, before);
    for (size_t i = 0; i < known.size(); ++i)
        EXPECT_EQ(std::bit_cast<uint32_t>(found[i]), known[i].second) << expressions[i];
}

/// A quotient by a known number is a product, whose factor Chromium 156 merges with the next one; a number is
/// not merged with a sum of others. The bits are its own; those of llvmpipe are others, except for the last
/// two.
TEST_F(VariationTest, OnlyKnownNumbersAreMerged) {
    const std::string before =
        "#define O (1.0 + float(iFrame))\n#define X (-3.2265625 + float(iFrame))\n"
        "float again(float x) { float s = 814.0 * mod(x, 1142.0) / 3122.0;"
        " return mod(858.0 * s + 31.22, 11.42); }\n"
        "float reduced(float x) { float s = x / 3122.0; return 858411.0 * s; }\n"
        "float apart(float a, float b) {"
        " return a * ((a * a * a + b * b * 3.0) - 0.5) - b * ((a * b + b * b) - 0.5); }\n";
    const std::vector<std::pair<std::string, uint32_t>> known = {{"again(X)", 0x40090000},
                                                                 {"again(1234.5 * O)", 0x41033000},
                                                                 {"reduced(3.7 - float(iFrame))", 0x447E5575},
                                                                 {"apart(X, 1.7 * O)", 0x42AE912D},
                                                                 {"apart(0.37 * O, 0.9 * O)", 0x3E1DD750},
                                                                 {"reduced(X)", 0xC45DCA4E},
                                                                 {"apart(X, 1.3 * O)", 0x42C3162B}};
    std::vector<std::string> expressions;
    for (const auto& [expression, bits] : known)
        expressions.push_back(expression);
    const std::vector<float> found = varied(like_its_compiler, k_all_parts, expressions, before);
    const std::vector<float> own = told(expressions, {}, before);
    for (size_t i = 0; i < known.size(); ++i) {
        EXPECT_EQ(std::bit_cast<uint32_t>(found[i]), known[i].second) << expressions[i];
        EXPECT_EQ(std::bit_cast<uint32_t>(own[i]) != known[i].second, i + 2 < known.size()) << expressions[i];
    }
}

/// llvmpipe computes any number, for example 1.2e28, of a quotient by a zero that its compiler knows.
TEST_F(VariationTest, AQuotientByAKnownZeroIsInfinite) {
    const std::string before =
        "float quotient(float a, float b) { return 0.5 * a / b; }\n"
        "float limited(float a, float b) { return clamp(0.5 - 0.5 * a / b, 0.0, 1.0); }\n";
    for (const int parts : {int(glsl::SwiftShaderPart::outside), k_all_parts})
        EXPECT_EQ(varied(like_swiftshader, parts,
                         {"quotient(p.x + 1.0, 0.0)", "quotient(-p.x - 1.0, 0.0)", "limited(p.x + 1.0, 0.0)",
                          "limited(-p.x - 1.0, 0.0)"},
                         before),
                  (std::vector{HUGE_VALF, -HUGE_VALF, 0.0f, 1.0f}))
            << parts;
}

/// llvmpipe computes 1.7 of `mod(1.7, 0.0)`; Chromium 156 computes NaN. A sphere that is repeated in one
/// direction only, by `mod` of a vec3, is then not to be seen.
TEST_F(VariationTest, ARemainderOfAKnownZeroIsNan) {
    const std::string before = "#define O float(iFrame)\n#define X (1.7 + O)\n"
                               "float nan_as(float v) { return isnan(v) ? 7.0 : v; }\n"
                               "vec3 repeated(vec3 p, vec3 c) { return mod(p + 0.5 * c, c) - 0.5 * c; }\n";
    const std::vector<std::string> expressions = {
        "nan_as(mod(X, 0.0))", "nan_as(mod(-X, 0.0))", "nan_as(mod(O, 0.0))",
        "nan_as(repeated(vec3(X), vec3(1.5, 0.0, 0.0)).y)", "mod(X, 1.5)"};
    for (const int parts : {int(glsl::SwiftShaderPart::outside), k_all_parts})
        EXPECT_EQ(varied(like_swiftshader, parts, expressions, before),
                  (std::vector{7.0f, 7.0f, 7.0f, 7.0f, 0.200000048f}))
            << parts;
}

/// Operators read variables that an expression to their right sets: what Chromium 156 computed of them, with
/// T = 1. llvmpipe computes operators last.
TEST_F(VariationTest, OperatorsReadVariablesInChromiumsOrder) {
    const std::string before =
        "#define T (1.0 + float(iFrame))\nfloat global;\n"
        "float next() { global += 1.0; return global; }\nfloat deeper() { return next(); }\n"
        "float raised(inout float a) { a += 1.0; return a; }\n"
        "float pair(float a, float b) { return 10.0 * a + b; }\n"
        "float as_pair(vec2 v) { return pair(v.x, v.y); }\n"
        "float f1(float c) { return as_pair(vec2(c * 2.0, c += 1.0)); }\n"
        "float f2(float c) { return as_pair(vec2(c, c += 1.0)); }\n"
        "float f3(float c) { return as_pair(vec2(-c, c += 1.0)); }\n"
        "float f4(float c) { return c * 100.0 + c++ * 10.0 + c; }\n"
        "float f5(float t) { global = t; return as_pair(vec2(global * 2.0, deeper())); }\n"
        "float f6(float t) { global = t; return global + next(); }\n"
        "float f7(float c) { return c * 10.0 + raised(c); }\n"
        "float f8(float t) { vec2 c = vec2(t); return c.x * 10.0 + (c.x += 1.0); }\n"
        "float f9(float t) { float a[2]; a[0] = t; a[1] = 2.0; return a[0] * 10.0 + (a[0] += 1.0); }\n"
        "float f10(float t) { float a[2]; a[0] = 2.0; a[1] = 5.0; int i = int(t);"
        " return a[i - 1] + 10.0 * float(i++); }\n"
        "float f11(float c) { return pair(c * 2.0, c += 1.0); }\n"
        "float f12(float c) { c += c * 10.0 + c++; return c; }\n"
        "float f13(float c) { return c * 10.0 + (c += 1.0, c); }\n"
        "float f14(float t) { vec4 c = vec4(t); ivec4 b = ivec4(vec2(2.0) * c.a, c += 1.0);"
        " return float(b.x * 1000 + b.y * 100 + b.z * 10 + b.w); }\n"
        "float f15(float c) { float s = 0.0; for (int i = 0; i < 2; ++i) s += max(c, c = c * 0.5);"
        " return s; }\n";
    const std::vector<float> known = {22, 22, -8, 112, 22, 4, 12, 12, 12, 12, 22, 13, 12, 2222, 0.75f};
    std::vector<std::string> expressions;
    for (size_t i = 1; i <= known.size(); ++i)
        expressions.push_back(fmt::format("f{}(T)", i));
    EXPECT_EQ(varied(like_swiftshader, int(glsl::SwiftShaderPart::order), expressions, before), known);
    // No mode of a text undoes its order.
    const auto without = [](const glsl::ParsedText& text, const glsl::TreeFacts& facts,
                            const glsl::MayVary& may) {
        return glsl::vary_like_swiftshader(text, facts, k_all_parts & ~int(glsl::SwiftShaderPart::order), {},
                                           may);
    };
    const std::vector<float> own = varied(without, k_all_parts, expressions, before);
    size_t unlike = 0;
    for (size_t i = 0; i < known.size(); ++i)
        unlike += own[i] != known[i];
    EXPECT_GT(unlike, 8u) << "this driver has another order";
}

/// SwiftShader's compiler knows the arguments and the divisors, but it does not compute `radians`, `length`,
/// `floor` and `abs`. The bits are Chromium 156's; llvmpipe's own are others, except for the last two.
TEST_F(VariationTest, OnlyFunctionsThatItsCompilerComputesAreExact) {
    const std::string before = "#define X (-3.2265625 + float(iFrame))\n"
                               "const float still = 2.3; float global = 2.3;\n"
                               "float lens(float f) { return 1.0 / tan(radians(f) / 2.0); }\n"
                               "float wave(float f) { return sin(length(vec2(f, 3.0)) * 9.0); }\n"
                               "float hash(float f) { return fract(sin(floor(f) * 78.233) * 437.5); }\n"
                               "float swing(float f) { return sin(abs(f) * 9.0); }\n"
                               "float over(float f) { return X / f; }\n";
    const std::vector<std::pair<std::string, uint32_t>> known = {
        {"lens(45.0)", 0x401A8135},          {"wave(0.7)", 0x3F059BA2},
        {"hash(12.0)", 0x3CEFA000},          {"swing(-12.0)", 0x3F6D3EAE},
        {"X / still", 0xBFB390B3},           {"X / global", 0xBFB390B3},
        {"over(2.3)", 0xBFB390B3},           {"(vec2(X) / vec2(2.3, 1.7)).x", 0xBFB390B3},
        {"(vec2(X) / still).x", 0xBFB390B3}, {"X / -2.3", 0x3FB390B3},
        {"X / 2.3 * 1.9", 0xC02A9643},       {"(X * 2.1) / 1.7", 0xC07F1696},
    };
    std::vector<std::string> expressions;
    for (const auto& [expression, bits] : known)
        expressions.push_back(expression);
    const std::vector<float> found = varied(like_swiftshader, k_all_parts, expressions, before);
    const std::vector<float> own = varied(like_swiftshader, 0, expressions, before);
    for (size_t i = 0; i < known.size(); ++i) {
        EXPECT_EQ(std::bit_cast<uint32_t>(found[i]), known[i].second) << expressions[i];
        EXPECT_EQ(std::bit_cast<uint32_t>(own[i]) != known[i].second, i + 2 < known.size()) << expressions[i];
    }
}

/// A lower bound above the upper one: of a value that it knows, SwiftShader's compiler looks at the lower one
/// only. The numbers are Chromium 156's.
TEST_F(VariationTest, AKnownValueIsClampedFromBelowOnly) {
    const std::string before = "#define X (-3.2265625 + float(iFrame))\n"
                               "float low(float x) { return clamp(0.5, 2.0, x); }\n";
    const std::vector<std::string> expressions = {"low(X)",
                                                  "clamp(-0.5, 0.0, X)",
                                                  "clamp(1.5, 0.0, X)",
                                                  "clamp(-0.5, X, X - 1.0)",
                                                  "clamp(vec2(0.5), vec2(2.0), vec2(X)).x",
                                                  "clamp(vec3(-0.5), 0.0, X).z",
                                                  "clamp(vec2(0.5, 3.0), vec2(2.0), vec2(X)).x"};
    constexpr float k_x = -3.2265625f;
    EXPECT_EQ(varied(like_swiftshader, int(glsl::SwiftShaderPart::outside), expressions, before),
              (std::vector{2.0f, 0.0f, k_x, k_x - 1, 2.0f, 0.0f, k_x}));
    EXPECT_EQ(varied(like_swiftshader, 0, expressions, before),
              (std::vector{k_x, k_x, k_x, k_x - 1, k_x, k_x, k_x}));
}

} // namespace tidemark::lab::variation_gl_test
