// Ranges that are known by hand, and doubts that must or must not remain.
#include "ir_support.hpp"
#include "proof/value_ranges.hpp"

namespace tidemark::proof::value_ranges_test {

struct Colour {
    Interval range;
    std::optional<PartialOperation> doubt;
    Function function;

    Op op() const { return doubt ? function.instructions[doubt->value].op : Op::undefined; }
};

/// The red of that main, with iTime in [0, 100] and gl_FragCoord.x in [0.5, 639.5].
Colour red_of(const std::string& main, const std::string& functions = "") {
    const Function function = compiled(functions, main);
    std::vector<Interval> memory(function.cells.size());
    if (const Variable* time = function.find("iTime"))
        memory[time->first] = {0, 100};
    if (const Variable* place = function.find("gl_FragCoord"))
        memory[place->first] = {0.5, 639.5};
    const ValueRanges ranges = value_ranges(function, memory, [](const Lookup&, std::span<const Interval>) {
        return Interval{0, 1};
    });
    EXPECT_TRUE(ranges.settled) << main;
    const uint32_t cell = function.find("color")->first;
    return {ranges.memory.at(cell), ranges.partial.at(cell), function};
}

void expect_range(const Colour& red, double low, double high) {
    EXPECT_FALSE(red.doubt);
    EXPECT_NEAR(red.range.low, std::min(low, 0.0), 1e-6); // what was never written is 0
    EXPECT_NEAR(red.range.high, high, 1e-6 * std::max(1.0, high));
    EXPECT_GE(red.range.high, high);
}

TEST(ValueRanges, follow_operations) {
    expect_range(red_of("color.x = sqrt(iTime + 21.0);"), 0, 11);
    expect_range(red_of("vec2 p = vec2(iTime - 50.0, 1.0); color.x = 1.0 / length(p);"), 0, 1);
    expect_range(red_of("color.x = texture(iChannel0, vec2(iTime)).x + 2.0;"), 0, 3);
}

TEST(ValueRanges, name_operations_that_leave_their_domain) {
    const Colour root = red_of("float x = iTime - 1.0; color.x = 2.0 * sqrt(x) + 1.0;");
    ASSERT_EQ(root.op(), Op::sqrt);
    EXPECT_NEAR(root.doubt->operands.at(0).low, -1, 1e-6);
    EXPECT_EQ(red_of("color.x = 1.0 / iTime;").op(), Op::divide);
    EXPECT_EQ(red_of("color.x = log(sin(iTime));").op(), Op::log);
    EXPECT_EQ(red_of("color.x = iTime * 1e39;").doubt->value, k_no_value); // that number is infinite
    EXPECT_EQ(red_of("color.x = normalize(vec2(iTime, 0.0)).x;").op(), Op::inverse_sqrt);
}

TEST(ValueRanges, use_conditions) {
    for (const char* guarded : {"float x = iTime - 1.0; if (x > 0.0) color.x = sqrt(x);",
                                "float x = iTime - 1.0; color.x = x > 0.0 ? sqrt(x) : 0.0;",
                                "float x = iTime - 1.0; if (!(x < 0.0)) color.x = sqrt(x);",
                                "float x = iTime - 1.0; if (x < 0.0) discard; color.x = sqrt(x);",
                                "float x = iTime - 1.0; if (x > 0.0 && iTime < 50.0) { color.x = 1.0; if (x "
                                "> 7.0) color.x = 1.0 / x; }",
                                "float x = sqrt(max(iTime - 1.0, 0.0)); color.x = x / (x + 1.0);"})
        EXPECT_FALSE(red_of(guarded).doubt) << guarded;
    // NaN is not less than 1 either.
    EXPECT_TRUE(red_of("float x = sqrt(iTime - 1.0); color.x = x < 1.0 ? 0.0 : x;").doubt);
    EXPECT_FALSE(red_of("float x = sqrt(iTime - 1.0); color.x = x < 1.0 ? x : 0.0;").doubt);
    // It jumps over the place where it would be 0, which an interval does not see.
    EXPECT_TRUE(red_of("float x = iTime > 50.0 ? 1.0 : -1.0; color.x = 1.0 / x;").doubt);
}

TEST(ValueRanges, converge_in_loops) {
    expect_range(
        red_of("float s = 0.0; for (int i = 0; i < 64; ++i) if (i > 3) s = 1.0 / float(i); color.x = s;"), 0,
        0.25);
    expect_range(red_of("int n = 0; while (n < 10 + int(gl_FragCoord.x)) n += 2; color.x = float(n);"), 0,
                 650);
    const Colour march =
        red_of("float t = 0.0; for (int i = 0; i < 99; ++i) { float d = 1.5 + sin(t); if (t > 20.0) break;\n"
               "t += d; } color.x = sqrt(t);");
    EXPECT_FALSE(march.doubt);
    EXPECT_LE(march.range.high, 5);
    EXPECT_FALSE(red_of("float x = 1.0; for (int i = 0; i < 9; ++i) x *= 1.5; color.x = 1.0 / x;").doubt);
    // A doubt that goes round in the loop: the first turn has none.
    EXPECT_TRUE(
        red_of(
            "float t = 0.0; for (int i = 0; i < 9; ++i) { if (t > 20.0) break; t += 1.0 / (iTime - 50.0); }\n"
            "color.x = exp(-t);")
            .doubt);
    // The divisor is only known once the loop is analysed.
    EXPECT_FALSE(
        red_of(
            "float c = 8.0, s = 0.0; for (int i = 0; i < 5; ++i) { s = 0.5 * s + pow(sin(iTime) + 1.0, c);\n"
            "c = mix(c, 1.0, 0.2); } color.x = s;")
            .doubt);
}

TEST(ValueRanges, of_memory_include_every_stored_value) {
    expect_range(red_of("float a[4]; for (int i = 0; i < 4; ++i) a[i] = float(i) + 1.0;\n"
                        "color.x = a[int(gl_FragCoord.x) & 3];"),
                 0, 4);
    EXPECT_TRUE(red_of("float a[4]; for (int i = 0; i < 4; ++i) a[i] = log(float(i) - 1.0);\n"
                       "color.x = a[int(gl_FragCoord.x) & 3];")
                    .doubt);
}

} // namespace tidemark::proof::value_ranges_test
