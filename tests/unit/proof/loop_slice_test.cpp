// A turn as a function of its own has the distances that the whole text has, and little else.
#include "ir_support.hpp"

#include <algorithm>

namespace tidemark::proof::loop_slice_test {

struct Sliced {
    Function function;
    LoopSlice slice;
};

Sliced sliced(const std::string& functions, const std::string& march) {
    Sliced result{compiled(functions, "vec3 ro = vec3(gl_FragCoord.x, 0.0, -3.0), rd = vec3(0.0, 0.0, 1.0);\n"
                                      "float t = 0.0, glow = 0.0;\n" +
                                          march + "\ncolor = vec4(t, glow, 0.0, 1.0);"),
                  {}};
    const auto loops = find_marching_loops(result.function);
    EXPECT_EQ(loops.size(), 1u);
    if (loops.size() == 1)
        result.slice = slice_of(result.function, loops[0]);
    return result;
}

/// It measures more than once, each time what the text measures there.
void expect_faithful(const Sliced& sliced) {
    const std::vector<MarchingLoop> loops{sliced.slice.loop};
    FloatEvaluator evaluator = entered(sliced.function, loops, 0.3f, 1.7f);
    const FloatEvaluator at_entry = evaluator;
    const March march = follow(evaluator, sliced.function, sliced.slice.loop);
    EXPECT_GT(march.turns.size(), 1u);
    EXPECT_TRUE(is_faithful(sliced.slice, at_entry, march));
}

size_t count(const LoopSlice& slice, Op op, const Block& block) {
    const auto& all = slice.function.instructions;
    return size_t(std::count_if(all.begin() + block.first, all.begin() + block.last,
                                [op](const Instruction& each) { return each.op == op; }));
}

size_t count(const LoopSlice& slice, Op op) {
    size_t sum = 0;
    for (const Block& block : slice.function.blocks)
        sum += count(slice, op, block);
    return sum;
}

TEST(LoopSlice, leaves_out_code_unused_by_the_distance) {
    const Sliced with_glow = sliced("vec2 map(vec3 p) { return vec2(length(p) - 1.0, exp(p.x) + tan(p.y)); }",
                                    "for (int i = 0; i < 99; ++i) { vec2 d = map(ro + rd * t); glow += d.y;\n"
                                    "if (d.x < 0.001 || t > 20.0) break; t += d.x; }\n"
                                    "glow = cos(glow + t);");
    expect_faithful(with_glow);
    EXPECT_EQ(count(with_glow.slice, Op::exp), 0u);
    EXPECT_EQ(count(with_glow.slice, Op::tan), 0u);
    EXPECT_EQ(count(with_glow.slice, Op::cos), 0u);
    EXPECT_EQ(count(with_glow.slice, Op::sqrt), 1u);
}

TEST(LoopSlice, hoists_values_constant_along_the_ray) {
    const Sliced turning =
        sliced("float map(vec3 p) { float s = sin(iTime), c = cos(iTime); p.xz = mat2(c, s, -s, c) * p.xz;\n"
               "return length(p - vec3(0.2, 0.0, 0.1 * s)) - 1.0; }",
               k_sphere_tracing);
    expect_faithful(turning);
    const Block& invariants = turning.slice.function.blocks[0];
    EXPECT_EQ(count(turning.slice, Op::sin, invariants), 1u);
    EXPECT_EQ(count(turning.slice, Op::sin), 1u);
    EXPECT_EQ(count(turning.slice, Op::load), count(turning.slice, Op::load, invariants));
    EXPECT_EQ(count(turning.slice, Op::sqrt, invariants), 0u);
}

TEST(LoopSlice, keeps_memory_written_and_read_in_an_iteration) {
    const Sliced stack =
        sliced("float map(vec3 p) { float parts[4]; for (int i = 0; i < 4; ++i) parts[i] = float(i) * 0.1;\n"
               "float d = 9.0; for (int i = 0; i < 4; ++i)\n"
               "d = min(d, length(p - vec3(parts[(i + int(iTime)) % 4], 0.0, 0.0)) - parts[3 - i] - 0.5);\n"
               "return d; }",
               k_sphere_tracing);
    EXPECT_TRUE(stack.slice.stores);
    expect_faithful(stack);
}

TEST(LoopSlice, follows_loops_and_branches_in_an_iteration) {
    expect_faithful(sliced(
        "float map(vec3 p) { float d = p.z > 0.5 ? 0.1 : length(p) - 0.2, a = 0.3;\n"
        "for (int i = 0; i < 5; ++i) { if (i == 3) continue; d -= a * sin(p.x * 3.0 + iTime); a *= 0.5; }\n"
        "return 0.5 * d; }",
        k_sphere_tracing));
    expect_faithful(sliced("float map(vec3 p) { return length(p) - 1.0; }",
                           "float d = 1.0; for (int i = 0; i < 99 && d > 1e-3; ++i) {\n"
                           "d = map(ro + t * rd); t += i == 1 ? 0.5 * d : d; }"));
}

TEST(LoopSlice, loops_left_before_measuring_have_no_distance) {
    const Sliced short_ray = sliced("float map(vec3 p) { return length(p) - 1.0; }",
                                    "for (int i = 0; i < 99; ++i) { if (t > 1.5) break;\n"
                                    "float d = map(ro + rd * t); if (d < 0.001) break; t += d; }");
    const std::vector<MarchingLoop> loops{short_ray.slice.loop};
    MarchSlice march(short_ray.slice, entered(short_ray.function, loops, 0));
    EXPECT_TRUE(march.distance({1.0, 1.25}, Care::quick));
    EXPECT_FALSE(march.distance({1.75, 2.0}, Care::quick));
}

} // namespace tidemark::proof::loop_slice_test
