// A text as other GPUs would compute it, and with its domains watched: what is led through us and what is
// not. What that draws is tested through the program, tests/cli/check_test.py.
#include "glsl_support.hpp"
#include "shader/domain_watch.hpp"
#include "shader/variation.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <tuple>

namespace tidemark::glsl::variation_test {

struct Read {
    std::unique_ptr<const ParsedText> text;
    TreeFacts facts;
};

Read read(const std::string& text) {
    text::MappedText source;
    source.append("#version 330 core\n" + text, "a.glsl", 0);
    auto parsed = ParsedText::read(std::move(source), {});
    EXPECT_TRUE(parsed);
    TreeFacts facts = find_facts(**parsed);
    return {*std::move(parsed), std::move(facts)};
}

Variation varied(Variation (*vary)(const ParsedText&, const TreeFacts&, const MayVary&),
                 const std::string& text) {
    const Read of = read(text);
    return vary(*of.text, of.facts, {});
}

TEST(Variation, OnlyBuiltInSinesAreReplaced) {
    const Variation found =
        varied(vary_sines, "const float c = sin(1.0);\nfloat f(float x) { return sin(x) + cos(x); }\n");
    EXPECT_EQ(found.places.size(), 2u);
    EXPECT_EQ(count(found.text, "return tmw0_sin ( x ) + tmw0_cos ( x )"), 1);
    EXPECT_EQ(varied(vary_sines, "float sin(float x) { return x; }\nfloat f(float x) { return sin(x); }\n")
                  .places.size(),
              0u);
}

TEST(Variation, ReadsThatAnExpressionToTheRightPrecedesInMesaAreFound) {
    const Read of =
        read("float g;\nfloat next() { return g++; }\nfloat f(float c, vec2 v, float a[3], int i) {\n"
             "float d = c * 2.0 + c++; d = c + c++; d = g * 3.0 + next(); d = a[i] + float(i++);\n"
             "d = c * 2.0, c++; d = v.x * 2.0 + (v.x = 1.0); return (c++, c * 2.0); }\n");
    std::vector<std::string> found;
    for (const NodeId id : reads_before_settings(*of.text, of.facts).early)
        found.push_back(of.text->excerpt(id));
    EXPECT_EQ(found, (std::vector<std::string>{"c", "g", "i", "v.x"}));
}

TEST(Variation, InexactOperationsAreWrapped) {
    const Variation found =
        varied(vary_rounding, "float f(float x) { x /= 3.0; return sqrt(x / 7.0) + x * x; }\n");
    EXPECT_EQ(found.places.size(), 3u);
    EXPECT_EQ(count(found.text, "(x /= 3.0,x =tmw0_off(x ))"), 1);
    EXPECT_EQ(count(found.text, "return tmw0_off(sqrt ( tmw0_off(x / 7.0) )) + x * x"), 1);
}

TEST(Variation, IntegersAndConstantsAreUnchanged) {
    EXPECT_EQ(
        varied(vary_rounding, "const float c = 1.0 / 2.0;\nint f(int i) { float a[2 / 1]; return i / 2; }\n")
            .places.size(),
        0u);
}

TEST(Variation, AProductAndItsSumBecomeFma) {
    const auto contracted = [](const std::string& expression) {
        const std::string text =
            varied(vary_contraction, "float f(float a, float b, float c) { return " + expression + "; }\n")
                .text;
        const size_t begin = text.find("return ", text.find("float f (")) + 7;
        return text.substr(begin, text.find(" ;", begin) - begin);
    };
    EXPECT_EQ(contracted("a * b + c"), "tmw0_sum(tmw0_product(a , b) , c)");
    EXPECT_EQ(contracted("c - a * b"), "tmw0_sum(c , -(tmw0_product(a , b)))");
    EXPECT_EQ(contracted("a * b - c / a"), "tmw0_sum(tmw0_product(a , b) , -(c / a))");
    EXPECT_EQ(contracted("c + (a * b)"), "tmw0_sum(c , ( tmw0_product(a , b) ))");
    EXPECT_EQ(contracted("a * b + b * c"), "tmw0_sum(tmw0_product(a , b) , b * c)") << "one of two";
    EXPECT_EQ(contracted("a += b * c"), "a =tmw0_sum(a , (tmw0_product(b , c)))");
    EXPECT_EQ(contracted("a -= b * c"), "a =tmw0_sum(a , -(tmw0_product(b , c)))");
    EXPECT_EQ(contracted("dot(a, b)"), "tmw0_dot ( a , b )");
    EXPECT_EQ(contracted("a + b - c / a"), "a + b - c / a");
    EXPECT_EQ(contracted("float(2 * 3 + int(a))"), "float ( 2 * 3 + int ( a ) )");
}

TEST(Variation, ASumIsAddedInReverseOrder) {
    const auto reversed = [](const std::string& expression) {
        const Variation found = varied(vary_order, "float f(float a, float b, float c, float d) { return " +
                                                       expression + "; }\n");
        const size_t begin = found.text.find("return ") + 7;
        return found.places.empty() ? "" : found.text.substr(begin, found.text.find(" ;") - begin);
    };
    EXPECT_EQ(reversed("a + b + c"), "a + (b + c)");
    EXPECT_EQ(reversed("a - b + c"), "a - (b - c)");
    EXPECT_EQ(reversed("a - b - c + d"), "a - (b + (c - d))");
    EXPECT_EQ(reversed("a + b - (b + c + d) * a"), "a + (b - ( b + (c + d) ) * a)");
    EXPECT_EQ(reversed("a + (b + c)"), "") << "parentheses are the author's order";
    EXPECT_EQ(reversed("float(1 + 2 + 3)"), "");
}

TEST(Variation, MediumpOperationsFollowThePrecisionQualifiers) {
    EXPECT_EQ(varied(vary_halves, "float f(float x) { return x * x; }\n").places.size(), 0u);
    const Variation found =
        varied(vary_halves, "precision mediump float;\nfloat f(float x) { return x * x; }\n");
    EXPECT_EQ(found.places.size(), 1u);
    EXPECT_EQ(count(found.text, "return tmw0_off(x * x)"), 1);
}

TEST(Variation, InputsAreTheHostsUniforms) {
    const Variation found =
        varied(vary_inputs, "uniform float iTime;\nfloat f(float iMouse) { return iTime + iMouse; }\n");
    EXPECT_EQ(found.places.size(), 1u);
    EXPECT_EQ(count(found.text, "return tmw0_input(iTime) + iMouse"), 1);
}

TEST(Variation, VariablesBecomePrecise) {
    const Variation found =
        varied(vary_precision, "float g;\nvoid main() { vec2 a = vec2(g); const float c = 1.0; int i; }\n");
    EXPECT_EQ(found.places.size(), 1u);
    EXPECT_EQ(count(found.text, "precise vec2 a"), 1);
}

TEST(Domains, CallsWithSafeArgumentsAreNotInstrumented) {
    const Read of =
        read("const float c = sqrt(2.0);\nfloat f(float x) {\n"
             "return sqrt(2.0) + pow(2.0, x) + mod(x, 4.0) + smoothstep(0.0, 1.0, x) + atan(x) +\n"
             "atan(x, 1.0) + pow(x, -2.0) + mod(x, x) + smoothstep(-0.5, (-0.5), x) + log(-1.0) +\n"
             "asin(0.5) + sqrt(0.0) + normalize(vec2(-2.0, 1.0)).x + acos(x); }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, DomainScope::floats);
    std::string names;
    for (const DomainSite& site : watch.sites)
        names += std::string(called_name(*of.text, site.node)) + " ";
    EXPECT_EQ(names, "pow mod smoothstep log acos ");
    EXPECT_EQ(count(watch.text, "tmw0_pow ( x , - 2.0 ,0,tmw0_m[0])"), 1);
}

TEST(Domains, QuotientsAreInstrumentedIfBothMayBeZero) {
    const Read of = read("float f(float x, int n, vec2 v) {\nx /= x; v.y /= v.x + 1.0; x /= 2.0;\n"
                         "return x / v.x + 1.0 / x + x / 3.0 + float(n / n) + x / max(x, 0.1) +\n"
                         "x / iResolution.x; }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, DomainScope::floats);
    EXPECT_EQ(watch.sites.size(), 3u);
    EXPECT_EQ(count(watch.text, "x =tmw0_quotient(x , (x),0,tmw0_m[0])"), 1);
    EXPECT_EQ(count(watch.text, "v . y =tmw0_quotient(v . y , (v . x + 1.0),1,tmw0_m[1])"), 1);
    EXPECT_EQ(count(watch.text, "return tmw0_quotient(x , v . x,2,tmw0_m[2]) + 1.0 / x + x / 3.0"), 1);
    EXPECT_EQ(domain_name(*of.text, watch.sites[0].node), "quotient");
}

TEST(Domains, WholeNumbersHaveBounds) {
    const Read of = read("float a[3];\nvoid f(int n, uint u, float x, vec3 v, sampler2D s) {\n"
                         "a[n] = a[1] + v[n]; n = 7 / n + 7 / 2 + 7 % n; n <<= n; u = u >> 3;\n"
                         "n = int(x) + int(u) + ivec2(v.xy).x; a[0] = texelFetch(s, ivec2(0), n).x; }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, DomainScope::everything);
    EXPECT_EQ(watch.sites.size(), 8u);
    EXPECT_EQ(watch.objectives.size(), 8u);
    EXPECT_EQ(count(watch.text, "a [ tmw0_index((n),int(a .length()),0,tmw0_m[0]) ] ="), 1);
    EXPECT_EQ(count(watch.text, "7 / tmw0_divisor((n),2,tmw0_m[2])"), 1);
    EXPECT_EQ(count(watch.text, "n <<= tmw0_shift((n),4,tmw0_m[4])"), 1);
    EXPECT_EQ(count(watch.text, "int ( tmw0_toint((x),5,tmw0_m[5]) )"), 1);
    EXPECT_EQ(count(watch.text, "tmw0_texelFetch ( s , ivec2 ( 0 ) , n ,7,tmw0_m[7])"), 1);
}

TEST(Domains, BothResultsOfAComparisonAreRecorded) {
    const Read of = read("void f(float x, int n) {\nif (x < 1.0 && n == 3) x = 0.0;\n"
                         "for (int i = 0; i < n; ++i) if (x != x) discard; }\nvoid main() { f(1.0, 2); }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, DomainScope::everything);
    ASSERT_EQ(watch.sites.size(), 2u);
    ASSERT_EQ(watch.objectives.size(), 3u);
    EXPECT_TRUE(watch.objectives[1].second && !watch.objectives[1].equality);
    EXPECT_TRUE(watch.objectives[2].equality);
    EXPECT_EQ(count(watch.text, "tmw0_less(x , 1.0,tmw0_m[0],tmw0_m[1])"), 1);
    EXPECT_EQ(count(watch.text, "tmw0_same(n , 3,tmw0_m[2],tmw0_none)"), 1);
    EXPECT_EQ(count(watch.text, "{tmw0_flush();discard ;}"), 1);
    EXPECT_EQ(count(watch.text, "void main(){tmw0_begin();tmw0_main();tmw0_flush();}"), 1);
}

TEST(Domains, ReadingsBelongToTheirSite) {
    DomainWatch watch;
    watch.sites.resize(2);
    watch.objectives = {{0}, {1}};
    const auto half = std::bit_cast<uint32_t>(0.5F), less = std::bit_cast<uint32_t>(-0.25F);
    const std::vector<uint32_t> words{0,
                                      0,
                                      0,
                                      0,
                                      3,
                                      ~77U,
                                      std::rotl(half, 1),
                                      9,
                                      ~half & 0x7fffffffU,
                                      (~half & 0x7ffff000U) | 5,
                                      less,
                                      (less & 0xfffff000U) | 6};
    ASSERT_EQ(words.size(), watch.words());
    const DomainReading reading = reading_of(watch, words, 1);
    EXPECT_EQ(std::tuple(reading.count, reading.pixel, reading.argument, reading.limit),
              std::tuple(3U, 77U, half, 9U));
    EXPECT_EQ(room_of(watch, words, 0).least, 0.5F);
    EXPECT_EQ(room_of(watch, words, 0).pixel, 5U);
    EXPECT_EQ(room_of(watch, words, 1).least, -0.25F);
    EXPECT_EQ(room_of(watch, words, 1).pixel, 6U);
}

TEST(Domains, AuthorFunctionsAreNotInstrumented) {
    const Read of = read("float sqrt(float x) { return x; }\nfloat f(float x) { return sqrt(x); }\n");
    EXPECT_TRUE(watch_domains(*of.text, of.facts, DomainScope::floats).sites.empty());
}

} // namespace tidemark::glsl::variation_test
