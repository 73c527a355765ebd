// Bounds of the turns of a march: never below what a march really needs, and not far above it.
#include "ir_support.hpp"
#include "proof/ray_proofs.hpp"

#include <gmock/gmock.h>

namespace tidemark::proof::turn_bound_test {

const std::string k_long_steps = "for (int i = 0; i < 200; ++i) { float d = map(ro + rd * t); "
                                 "if (d < 0.001 || t > 20.0) break; t += 0.7 * d; }";

struct Bounded {
    std::optional<uint32_t> most;
    size_t needed = 0;
};

Bounded bounded(const std::string& field, const std::string& text, float x) {
    const Function function = marcher(field, text);
    const auto loops = find_marching_loops(function);
    EXPECT_EQ(loops.size(), 1u) << text;
    if (loops.empty() || loops[0].advance == k_no_value || !loops[0].turns)
        return {};
    FloatEvaluator evaluator = entered(function, loops, x);
    const LoopSlice turn = slice_of(function, loops[0], SliceOf::step);
    MarchSlice slice(turn, evaluator);
    const March march = follow(evaluator, function, loops[0]);
    return {most_turns(slice, slice.end(march), *loops[0].turns, 2000), march.turns.size()};
}

TEST(TurnBound, is_a_tight_bound_of_the_iterations) {
    for (const std::string& text : {k_sphere_tracing, k_long_steps})
        for (const float x : {0.0f, 0.5f, 0.9f, 1.2f, 3.0f}) {
            const Bounded found = bounded("length(p) - 1.0", text, x);
            ASSERT_TRUE(found.most) << x;
            EXPECT_GE(*found.most, found.needed) << x;
            EXPECT_LE(*found.most, 3 * found.needed + 8) << x;
        }
}

TEST(TurnBound, exists_for_the_other_forms_of_a_march) {
    for (const std::string text :
         {"float d = 1.0; for (int i = 0; i < 200 && d > 1e-3 && t < 9.0; ++i) { d = map(ro + t * rd); t += "
          "d; "
          "}",
          "float d = 0.0; for (float i = 0.0; i < 1.0; i += 0.005) { t += d; d = map(ro + rd * t); "
          "if (d < 0.001 || t > 9.0) break; }",
          "vec3 p = ro, go = rd + vec3(0.1 * iTime); for (int i = 0; i < 200; ++i) { float d = map(p); "
          "if (d < 1e-3) break; p += go * max(d, 0.01); }\nt = p.z;"}) {
        const Bounded found = bounded("length(p) - 1.0", text, 0.5f);
        ASSERT_TRUE(found.most) << text;
        EXPECT_GE(*found.most, found.needed) << text;
    }
}

/// A march that crawls along a surface, or steps through a thin one, is not bounded.
TEST(TurnBound, is_missing_for_too_short_or_too_long_steps) {
    EXPECT_FALSE(bounded("0.0011 + 0.0001 * sin(p.z)", k_sphere_tracing, 0).most);
    EXPECT_FALSE(bounded("length(p) - 1.0",
                         "for (int i = 0; i < 5; ++i) { float d = map(ro + rd * t); "
                         "if (d < 0.001 || t > 20.0) break; t += 0.1 * d; }",
                         0)
                     .most);
    EXPECT_FALSE(bounded("3.0 * (length(p) - 0.1)", k_sphere_tracing, 0).most);
}

TEST(TurnBound, is_missing_for_a_non_finite_start) {
    for (const char* start : {"0.0 / iTime", "1.0 / iTime", "-1.0 / iTime"})
        EXPECT_FALSE(bounded("length(p) - 1.0", "t = " + std::string(start) + ";" + k_sphere_tracing, 0).most)
            << start;
}

TEST(TurnBound, holds_for_all_rays_of_an_area) {
    const Function function = marcher("length(p) - 1.0", k_sphere_tracing);
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u);
    Evaluator<IntervalSystem> all(function);
    all.memory()[function.find("gl_FragCoord")->first] = {-0.2, 0.2};
    ASSERT_TRUE(enter_first(all, loops));
    const LoopSlice turn = slice_of(function, loops[0], SliceOf::step);
    MarchSlice slice(turn, all);
    const auto most = most_turns(slice, 20, 100, 2000);
    ASSERT_TRUE(most);
    for (const float x : {-0.2f, -0.1f, 0.0f, 0.15f}) {
        FloatEvaluator one = entered(function, loops, x);
        EXPECT_GE(*most, follow(one, function, loops[0]).turns.size()) << x;
    }
}

/// If x is below 0 the march begins at NaN and takes all iterations.
TEST(TurnBound, is_missing_if_a_ray_of_the_area_may_have_a_non_finite_start) {
    const Function function = marcher("length(p) - 1.0", "t = sqrt(gl_FragCoord.x);" + k_sphere_tracing);
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u);
    const LoopSlice turn = slice_of(function, loops[0], SliceOf::step);
    const auto most_of = [&](const Interval& x) {
        Evaluator<IntervalSystem> all(function);
        all.memory()[function.find("gl_FragCoord")->first] = x;
        EXPECT_TRUE(enter_first(all, loops));
        MarchSlice slice(turn, all);
        return most_turns(slice, 20, 100, 2000);
    };
    EXPECT_TRUE(most_of({0.1, 0.2}));
    EXPECT_FALSE(most_of({-0.2, 0.2}));
    FloatEvaluator one = entered(function, loops, -0.1f);
    EXPECT_EQ(follow(one, function, loops[0]).turns.size(), 100u);
}

} // namespace tidemark::proof::turn_bound_test
