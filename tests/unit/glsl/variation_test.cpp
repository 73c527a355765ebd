// A text as other GPUs would compute it, and with its domains watched: what is led through us and what is
// not. What that draws is tested through the program, tests/cli/check_test.py.
#include "glsl/watch/domains.hpp"
#include "glsl/watch/variation.hpp"
#include "glsl_support.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl {
namespace {

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

Variation varied(Variation (*vary)(const ParsedText&, const TreeFacts&), const std::string& text) {
    const Read of = read(text);
    return vary(*of.text, of.facts);
}

TEST(Variation, SinesAreTheBuiltInOnes) {
    const Variation found =
        varied(vary_sines, "const float c = sin(1.0);\nfloat f(float x) { return sin(x) + cos(x); }\n");
    EXPECT_EQ(found.places, 2u);
    EXPECT_EQ(count(found.text, "return tmw0_sin ( x ) + tmw0_cos ( x )"), 1);
    EXPECT_EQ(
        varied(vary_sines, "float sin(float x) { return x; }\nfloat f(float x) { return sin(x); }\n").places,
        0u);
}

TEST(Variation, WhatGlslLetsBeOffIsLedThroughUs) {
    const Variation found =
        varied(vary_rounding, "float f(float x) { x /= 3.0; return sqrt(x / 7.0) + x * x; }\n");
    EXPECT_EQ(found.places, 3u);
    EXPECT_EQ(count(found.text, "(x /= 3.0,x =tmw0_off(x ))"), 1);
    EXPECT_EQ(count(found.text, "return tmw0_off(sqrt ( tmw0_off(x / 7.0) )) + x * x"), 1);
}

TEST(Variation, WholeNumbersAndConstantsAreLeftAlone) {
    EXPECT_EQ(
        varied(vary_rounding, "const float c = 1.0 / 2.0;\nint f(int i) { float a[2 / 1]; return i / 2; }\n")
            .places,
        0u);
}

TEST(Variation, AProductGoesIntoItsSumWhole) {
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

TEST(Variation, ASumIsAddedUpFromItsOtherEnd) {
    const auto reversed = [](const std::string& expression) {
        const Variation found = varied(vary_order, "float f(float a, float b, float c, float d) { return " +
                                                       expression + "; }\n");
        const size_t begin = found.text.find("return ") + 7;
        return found.places == 0 ? "" : found.text.substr(begin, found.text.find(" ;") - begin);
    };
    EXPECT_EQ(reversed("a + b + c"), "a + (b + c)");
    EXPECT_EQ(reversed("a - b + c"), "a - (b - c)");
    EXPECT_EQ(reversed("a - b - c + d"), "a - (b + (c - d))");
    EXPECT_EQ(reversed("a + b - (b + c + d) * a"), "a + (b - ( b + (c + d) ) * a)");
    EXPECT_EQ(reversed("a + (b + c)"), "") << "parentheses are the author's order";
    EXPECT_EQ(reversed("float(1 + 2 + 3)"), "");
}

TEST(Variation, HalvesAreThoseThatTheTextAsksFor) {
    EXPECT_EQ(varied(vary_halves, "float f(float x) { return x * x; }\n").places, 0u);
    const Variation found =
        varied(vary_halves, "precision mediump float;\nfloat f(float x) { return x * x; }\n");
    EXPECT_EQ(found.places, 1u);
    EXPECT_EQ(count(found.text, "return tmw0_off(x * x)"), 1);
}

TEST(Variation, InputsAreTheHostsUniforms) {
    const Variation found =
        varied(vary_inputs, "uniform float iTime;\nfloat f(float iMouse) { return iTime + iMouse; }\n");
    EXPECT_EQ(found.places, 1u);
    EXPECT_EQ(count(found.text, "return tmw0_input(iTime) + iMouse"), 1);
}

TEST(Variation, VariablesBecomePrecise) {
    const Variation found =
        varied(vary_precision, "float g;\nvoid main() { vec2 a = vec2(g); const float c = 1.0; int i; }\n");
    EXPECT_EQ(found.places, 1u);
    EXPECT_EQ(count(found.text, "precise vec2 a"), 1);
}

TEST(Domains, CallsThatTheTextItselfSettlesAreNotWatched) {
    const Read of =
        read("const float c = sqrt(2.0);\nfloat f(float x) {\n"
             "return sqrt(2.0) + pow(2.0, x) + mod(x, 3.0) + smoothstep(0.0, 1.0, x) + atan(x) +\n"
             "atan(x, 1.0) + pow(x, -2.0) + mod(x, x) + smoothstep(-0.5, (-0.5), x) + log(-1.0); }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, 64);
    std::string names;
    for (const NodeId call : watch.calls)
        names += std::string(called_name(*of.text, call)) + " ";
    EXPECT_EQ(names, "pow mod smoothstep log ");
    EXPECT_EQ(count(watch.text, "tmw0_pow ( x , - 2.0 ,0)"), 1);
}

TEST(Domains, QuotientsAreWatchedWhereBothMayBeZero) {
    const Read of = read("float f(float x, int n, vec2 v) {\nx /= x; v.y /= v.x + 1.0; x /= 2.0;\n"
                         "return x / v.x + 1.0 / x + x / 3.0 + float(n / n) + x / max(x, 0.1) +\n"
                         "x / iResolution.x; }\n");
    const DomainWatch watch = watch_domains(*of.text, of.facts, 64);
    EXPECT_EQ(watch.calls.size(), 3u);
    EXPECT_EQ(count(watch.text, "x =tmw0_quotient(x , (x),0)"), 1);
    EXPECT_EQ(count(watch.text, "v . y =tmw0_quotient(v . y , (v . x + 1.0),1)"), 1);
    EXPECT_EQ(count(watch.text, "return tmw0_quotient(x , v . x,2) + 1.0 / x + x / 3.0"), 1);
    EXPECT_EQ(domain_name(*of.text, watch.calls[0]), "quotient");
}

TEST(Domains, AFunctionOfTheAuthorsIsItsOwnAffair) {
    const Read of = read("float sqrt(float x) { return x; }\nfloat f(float x) { return sqrt(x); }\n");
    EXPECT_TRUE(watch_domains(*of.text, of.facts, 64).calls.empty());
}

} // namespace
} // namespace tidemark::glsl
