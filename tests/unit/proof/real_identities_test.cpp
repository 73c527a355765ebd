// By hand and as the function: intervals see the same.
#include "ir_support.hpp"
#include "proof/function_builder.hpp"

namespace tidemark::proof::real_identities_test {

/// Bounds of an expression in x and y over [0.1, 0.9] and [0.2, 0.8], which intervals see no relation
/// between.
Interval bounds_of(const std::string& expression) {
    const Function function = compiled("", "float x = gl_FragCoord.x, y = gl_FragCoord.y;\n"
                                           "color = vec4(" +
                                               expression + ", 0.0, 0.0, 0.0);");
    Evaluator<IntervalSystem> evaluator(function);
    const uint32_t place = function.find("gl_FragCoord")->first;
    evaluator.memory()[place] = {0.1, 0.9};
    evaluator.memory()[place + 1] = {0.2, 0.8};
    Decisions none(0);
    EXPECT_EQ(evaluator.run(none, [](uint32_t) { return true; }), Ended::left);
    return evaluator.memory()[function.find("color")->first];
}

void expect_same(const std::string& by_hand, double low, double high) {
    const Interval found = bounds_of(by_hand);
    EXPECT_NEAR(found.low, low, 1e-6) << by_hand;
    EXPECT_NEAR(found.high, high, 1e-6) << by_hand;
}

TEST(RealIdentities, fractional_parts_are_recognised) {
    expect_same("x - floor(x)", 0.1, 0.9);
    expect_same("x - fract(x)", 0, 0);
    expect_same("x - 1.0 * floor(x / 1.0)", 0.1, 0.9);
    expect_same("x - mod(x, 2.0)", 0, 0);
    expect_same("(x + 0.7) - 2.0 * round((x + 0.7) / 2.0)", -1, 1);
    expect_same("x * x", 0.01, 0.81);
}

TEST(RealIdentities, handwritten_mix_is_recognised) {
    expect_same("1.0 + x * (3.0 - 1.0)", 1.2, 2.8);
    expect_same("y + x * (2.0 - y)", 0.38, 1.88);
    expect_same("y * (1.0 - x) + 2.0 * x", 0.38, 1.88);
    expect_same("x * 2.0 + (1.0 - x) * y", 0.38, 1.88);
}

TEST(RealIdentities, handwritten_smoothstep_is_recognised) {
    expect_same("x * x * (3.0 - 2.0 * x)", 0.028, 0.972);
    expect_same("x * x * (3.0 - x * 2.0)", 0.028, 0.972);
    expect_same("x * x * x * (x * (x * 6.0 - 15.0) + 10.0)", 0.00856, 0.99144);
    expect_same("x * x * x * (10.0 + x * (6.0 * x - 15.0))", 0.00856, 0.99144);
}

TEST(RealIdentities, handwritten_min_is_recognised) {
    expect_same("(x < y ? x : y)", 0.1, 0.8);
    expect_same("(x > y ? x : y)", 0.2, 0.9);
}

TEST(RealIdentities, similar_expressions_are_not_rewritten) {
    expect_same("x - floor(y)", 0.1, 0.9);
    expect_same("x * x * (3.0 - 2.0 * y)", 0.01 * 1.4, 0.81 * 2.6);
    expect_same("y + x * (2.0 - x)", 0.2 + 0.1 * 1.1, 0.8 + 0.9 * 1.9);
}

} // namespace tidemark::proof::real_identities_test
