#include "ir_support.hpp"

#include <gmock/gmock.h>

#include <bit>

namespace tidemark::proof::marching_loop_test {

using Kind = MarchingLoop::Kind;

std::vector<MarchingLoop> loops_of(const std::string& march, const std::string& field = "length(p) - 1.0") {
    return find_marching_loops(marcher(field, march));
}

/// One loop, and of the pixel at x = 0 it tells its own distances from the place alone.
void expect_loop(const std::string& march, Kind kind, size_t carried) {
    const Function function = marcher("length(p) - 1.0", march);
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u) << march;
    EXPECT_EQ(loops[0].kind, kind) << march;
    EXPECT_EQ(loops[0].carried.size(), carried) << march;
    FloatEvaluator evaluator = entered(function, loops, 0);
    const FloatEvaluator at_entry = evaluator;
    const March followed = follow(evaluator, function, loops[0]);
    EXPECT_GT(followed.turns.size(), 1u) << march;
    EXPECT_TRUE(is_faithful(slice_of(function, loops[0]), at_entry, followed)) << march;
}

TEST(MarchingLoop, is_found_in_the_forms_that_authors_write) {
    expect_loop(k_sphere_tracing, Kind::sphere_tracing, 1);
    expect_loop("for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t); t += 0.7 * d; if (abs(d) < 1e-3) "
                "break; }",
                Kind::sphere_tracing, 1);
    expect_loop("float d = 1.0; for (int i = 0; i < 99 && d > 1e-3; ++i) { d = map(ro + t * rd); t += d; }",
                Kind::sphere_tracing, 1);
    expect_loop("float d = 1.0; while (d > 1e-3 * t && t < 9.0) { d = map(ro + rd * t); t += max(d, 0.01); }",
                Kind::sphere_tracing, 1);
    expect_loop(
        "vec3 p = ro; for (int i = 0; i < 99; ++i) { float d = map(p); if (d < 1e-3) break; p += rd * d; }\n"
        "t = p.z;",
        Kind::sphere_tracing, 3);
    expect_loop("vec3 p = ro, go = rd + vec3(iTime, 2.0 * iTime, iTime);\n"
                "for (int i = 0; i < 99; ++i) { float d = map(p); if (d < 1e-3) break; p += go * d * 0.9; "
                "}\nt = p.z;",
                Kind::sphere_tracing, 3);
    expect_loop(
        "for (int i = 0; i < 99; ++i) { vec3 p = ro + rd * t; float d = p.x < 0.5 ? map(p) : map(p.yxz);\n"
        "if (d < 1e-3) { t = min(t, 8.0); break; } if (t > 9.0) { t = 20.0; break; } t += d; }",
        Kind::sphere_tracing, 1);
    expect_loop("for (int i = 0; i < 400; ++i) { t += 0.01; if (map(ro + rd * t) < 0.0) break; }",
                Kind::fixed_step, 1);
}

TEST(MarchingLoop, is_found_if_the_distance_depends_on_an_index) {
    expect_loop("for (int i = 0; i < 99; ++i) { vec3 p = ro + rd * t, q = p;\n"
                "for (int k = 0; k < 3; ++k) q[k] = abs(p[(k + 1) % 3]);\n"
                "float d = map(q); if (d < 1e-3) break; t += d; }",
                Kind::sphere_tracing, 1);
}

TEST(MarchingLoop, is_found_with_growing_steps) {
    expect_loop("t = 0.1; for (int i = 0; i < 400; ++i) { if (map(ro + rd * t) < 0.0) break; t *= 1.02; }",
                Kind::fixed_step, 1);
    expect_loop(
        "t = 0.1; for (int i = 0; i < 400; ++i) { if (map(ro + rd * t) < 0.0) break; t += 0.02 * t; }",
        Kind::fixed_step, 1);
    expect_loop("float dt = 0.01; for (int i = 0; i < 400; ++i) { if (map(ro + rd * t) < 0.0) break;\n"
                "t += dt; dt = 0.02 * t; }",
                Kind::fixed_step, 1);
    expect_loop(
        "vec3 p = ro, go = rd + vec3(iTime, 2.0 * iTime, 0.1 + iTime); float dt = 0.01;\n"
        "for (int i = 0; i < 400; ++i) { if (map(p) < 0.0) break; p += go * dt; dt *= 1.01; }\nt = p.z;",
        Kind::fixed_step, 3);
    expect_loop("float dt = 0.01; for (int i = 0; i < 400; ++i) { if (map(ro + rd * t) < 0.0) break;\n"
                "t += dt; dt *= 1.05; }",
                Kind::fixed_step, 1);
}

TEST(MarchingLoop, may_have_a_threshold_that_grows_each_iteration) {
    expect_loop("float eps = 0.001; for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t);\n"
                "if (d < eps || t > 9.0) break; t += 0.5 * d; eps *= 1.1; }",
                Kind::sphere_tracing, 1);
    expect_loop("float eps = 0.001; for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t);\n"
                "if (d < eps || t > 9.0) break; t += 0.5 * d; eps = 0.001 * t; }",
                Kind::sphere_tracing, 1);
    expect_loop("for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t);\n"
                "if (d < 0.001 * float(1 + i)) break; t += 0.5 * d; }",
                Kind::sphere_tracing, 1);
    expect_loop("float eps = 0.001; for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t);\n"
                "eps *= 1.0 + 0.03 * t; if (d < eps || t > 9.0) break; t += 0.5 * d; }",
                Kind::sphere_tracing, 1);
}

TEST(MarchingLoop, may_idle_after_its_end) {
    expect_loop("float d = 1.0, eps = 0.001; for (int i = 0; i < 99; ++i) if (d > eps && t < 9.0) {\n"
                "d = map(ro + rd * t); eps = 0.001 * exp(0.1 * t); t += 0.5 * d; }",
                Kind::sphere_tracing, 1);
    expect_loop("float d = 1.0, glow = 0.0; for (int i = 0; i < 99; ++i) { if (d < 0.001) continue;\n"
                "d = map(ro + rd * t); glow += exp(-d); t += 0.5 * d; } t += glow;",
                Kind::sphere_tracing, 1);
    // The condition reads more than the part that is left out.
    EXPECT_TRUE(loops_of("float d = 1.0; for (int i = 0; i < 99; ++i) { if (d > 0.001)\n"
                         "{ d = map(ro + rd * t); t += 0.5 * d; } else d += 0.1; }")
                    .empty());
}

/// Planes and octahedra are made of sums, products and absolute values.
TEST(MarchingLoop, may_measure_a_field_of_sums_and_absolute_values_alone) {
    for (const char* field : {"abs(p.x) + abs(p.y) + abs(p.z) - 1.0", "0.3 - p.z", "abs(p.z) - 0.5"})
        for (const std::string& march :
             {k_sphere_tracing,
              std::string("float d = 1.0; for (int i = 0; i < 99 && abs(d) > 1e-3; ++i) {\n"
                          "d = map(ro + rd * (t + iTime)); t += min(0.7 * d, 2.0); }"),
              std::string("vec3 p = ro; for (int i = 0; i < 99; ++i) { float d = map(p);\n"
                          "if (d < 1e-3) break; p += rd * d; }\nt = p.z;")}) {
            if (march.starts_with("vec3 p") && std::string(field).find("p.y") == std::string::npos)
                continue; // one number that approaches another: no ray is recognised
            const auto loops =
                find_marching_loops(compiled(std::string("float map(vec3 p) { return ") + field + "; }",
                                             "vec3 ro = vec3(gl_FragCoord.x, 0.0, -3.0), rd = vec3(0.1 * "
                                             "iTime, 0.2 * iTime, 1.0 + iTime);\n"
                                             "float t = 0.0;\n" +
                                                 march + "\ncolor = vec4(t);"));
            ASSERT_EQ(loops.size(), 1u) << field << ": " << march;
            EXPECT_EQ(loops[0].kind, Kind::sphere_tracing) << field << ": " << march;
        }
    // Approaches a number, and searches a root by Newton's method.
    EXPECT_TRUE(loops_of("for (int i = 0; i < 99; ++i) { float d = 3.0 - t; if (abs(d) < 1e-3) break; "
                         "t += 0.1 * d; }")
                    .empty());
    EXPECT_TRUE(loops_of("t = 1.0 + iTime; for (int i = 0; i < 99; ++i) { float d = t * t - 2.0;\n"
                         "if (abs(d) < 1e-3) break; t -= d / (2.0 * t); }")
                    .empty());
}

/// The first march tests a distance of the iteration before against a function of the place, with steps of
/// two kinds; its form is not known. Rays to a light start where it ends.
TEST(MarchingLoop, is_not_that_of_a_shadow_after_a_march_of_another_form) {
    const std::string shadow =
        "for (int i = 0; i < 18; ++i) { float h = map(ro + rd * s); s += 0.3 * h; if (h < "
        "1e-3 || s > 2.0) break; } t = s;";
    const std::string unknown = "vec3 p = ro; float before = 1.0; for (int i = 0; i < 60; ++i) {\n"
                                "if (before < 0.01 * log(t) || t > 9.0) break; before = map(p);\n"
                                "t += before * (before > 0.1 ? 0.2 : 0.1); p = ro + rd * t; }\n";
    EXPECT_TRUE(loops_of(unknown).empty());
    EXPECT_TRUE(loops_of(unknown + "ro = p; float s = 0.0; " + shadow).empty());
    // A sum of octaves, counted in floats, is not a march; the loop after it may be the view's.
    EXPECT_EQ(
        loops_of("float high = 0.0; for (float k = 0.0; k < 5.0; ++k) high += sin(k * iTime); ro.y = high;\n"
                 "float s = 0.0; " +
                 shadow)
            .size(),
        1u);
}

TEST(MarchingLoop, detects_a_refinement_after_the_loop) {
    const auto goes_back = [](const std::string& step, const std::string& after) {
        const auto loops =
            loops_of("float before = 0.0, dt = 0.01 + 0.01 * iTime; for (int i = 0; i < 400; ++i) {\n"
                     "float d = map(ro + rd * t); if (d < 0.0) break; " +
                     step + " }\n" + after);
        EXPECT_EQ(loops.size(), 1u) << step << after;
        return loops.size() == 1 && loops[0].goes_back;
    };
    EXPECT_TRUE(goes_back("t += 0.01;", "t = t - 0.01 * iTime;"));
    EXPECT_TRUE(goes_back("t += 0.01;", "t -= 0.01;"));
    EXPECT_TRUE(goes_back("before = t; t += dt; dt *= 1.01;", "t = mix(before, t, 0.5);"));
    EXPECT_TRUE(goes_back("before = d; t += dt;", "t += before;"));
    EXPECT_TRUE(goes_back("t += dt;", "for (int k = 0; k < 8; ++k) { dt *= 0.5;\n"
                                      "t += map(ro + rd * t) < 0.0 ? -dt : dt; }"));
    EXPECT_FALSE(goes_back("t += 0.01;", "color = vec4(exp(-0.1 * t)); t = 9.0 - t;"));
    EXPECT_FALSE(goes_back("t += 0.01;", "t = length(ro + rd * t);"));
}

TEST(MarchingLoop, may_continue_in_the_code_after_its_last_iteration) {
    const std::string march = "for (int i = 0; i < 4; ++i) { float d = map(ro + rd * t);\n"
                              "if (d < 1e-3) break; t += 0.5 * d; }";
    for (const auto& [field, hits] :
         {std::pair("length(p) - 1.0", true), std::pair("p.z * p.z + 9.0 + sin(p.z)", false)}) {
        const Function function = marcher(field, march);
        const auto loops = find_marching_loops(function);
        ASSERT_EQ(loops.size(), 1u);
        FloatEvaluator evaluator = entered(function, loops, 0), again = evaluator;
        EXPECT_EQ(follow(evaluator, function, loops[0]).turns.size(), 4u);
        const March longer = follow_on(again, function, loops[0], 40);
        EXPECT_EQ(longer.hit, hits) << field;
        EXPECT_EQ(longer.turns.size(), hits ? 12u : 40u) << field;
    }
}

TEST(MarchingLoop, has_the_number_of_iterations) {
    const auto turns = [](const std::string& head) {
        const auto loops = loops_of("int n = 0; float h = 0.0, eps = 1e-3; " + head +
                                    " { float d = map(ro + rd * t); if (d < eps) break; t += d; }");
        return loops.size() == 1 ? loops[0].turns : std::nullopt;
    };
    EXPECT_EQ(turns("for (int i = 0; i < 100; ++i)"), 100u);
    EXPECT_EQ(turns("for (int i = 64; i > 0; i -= 2)"), 32u);
    EXPECT_EQ(turns("for (float i = 0.0; i < 1.0; i += 0.01)"), 101u); // each sum is rounded
    EXPECT_EQ(turns("while (n++ < 50)"), 50u);
    EXPECT_EQ(turns("for (int i = 0; i < int(iTime); ++i)"), std::nullopt);
}

/// A hit is what falls below the threshold of the first turn: one that shrinks is another question.
TEST(MarchingLoop, with_a_threshold_that_shrinks_is_not_faithful) {
    const Function function =
        marcher("length(p) - 1.0", "float eps = 0.1; for (int i = 0; i < 99; ++i) {\n"
                                   "float d = map(ro + rd * t); if (d < eps) break; t += 0.5 * d; "
                                   "eps *= 0.9; }");
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u);
    FloatEvaluator evaluator = entered(function, loops, 0);
    const FloatEvaluator at_entry = evaluator;
    const March followed = follow(evaluator, function, loops[0]);
    EXPECT_TRUE(followed.hit);
    EXPECT_FALSE(is_faithful(slice_of(function, loops[0]), at_entry, followed));
}

/// At the test, a distance that is summed up after it lags by one iteration.
TEST(MarchingLoop, carries_only_inputs_of_its_distance) {
    const std::string march = "vec3 p = ro, go = vec3(iTime, 2.0 * iTime, 0.1 + iTime);\n"
                              "for (int i = 0; i < 100; ++i) { p += go; if (map(p) < 0.0) break; t += 0.1; }";
    expect_loop(march, Kind::fixed_step, 3);
    const Function function = marcher("length(p) - 1.0", march);
    const auto loops = find_marching_loops(function);
    FloatEvaluator evaluator = entered(function, loops, 0);
    const LoopSlice turn = slice_of(function, loops[0]);
    const MarchSlice slice(turn, evaluator);
    const March followed = follow(evaluator, function, loops[0]);
    EXPECT_NEAR(slice.parameter(followed.turns.back()) * slice.unit(), 2.1, 1e-4);
}

TEST(MarchingLoop, has_the_end_of_the_ray_and_the_line_of_the_test) {
    const auto loops = loops_of(k_sphere_tracing);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_NE(loops[0].far, k_no_value);
    EXPECT_EQ(loops[0].line, 9);
}

TEST(MarchingLoop, hits_at_the_exit_near_the_surface_only) {
    const std::string march =
        "for (int i = 0; i < 99; ++i) { float d = map(ro + rd * t);\nif (d > 10.0) { t = 99.0; break; }\n"
        "if (d <= 0.01) break;\nt += d * 0.9; }";
    const Function function = marcher("length(p) - 1.0", march);
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_TRUE(loops[0].stops_before);
    const Instruction& threshold = function.instructions[loops[0].threshold];
    ASSERT_EQ(threshold.op, Op::constant);
    EXPECT_EQ(std::bit_cast<float>(threshold.immediate), 0.01f);
}

TEST(MarchingLoop, is_not_a_loop_that_only_sums) {
    // Counts samples, adds up a density, and looks how far it has come.
    EXPECT_TRUE(
        loops_of("for (float i = 0.0; i < 4.0 + min(iTime, 0.0); ++i) t += map(ro + i * rd);").empty());
    EXPECT_TRUE(loops_of("float sum = 0.0; for (int i = 0; i < 99; ++i) { sum += exp(-map(ro + t * rd));\n"
                         "if (sum > 0.99) break; t += 0.1; } t = sum;")
                    .empty());
    EXPECT_TRUE(
        loops_of(
            "for (int i = 0; i < 99; ++i) { t += map(ro + t * rd); if (abs(t) < 1e-3 || t > 20.0) break; }")
            .empty());
}

TEST(MarchingLoop, with_state_other_than_its_place_is_not_faithful) {
    for (const char* march :
         {"int seen = 0; for (int i = 0; i < 99; ++i) {\n"
          "float d = map(ro + rd * t) + 0.1 * float(seen); if (d < 1e-3) break; t += 0.5 * d; ++seen; }",
          "vec3 seen = vec3(0.0); for (int i = 0; i < 99; ++i) {\n"
          "float d = map(ro + rd * t) + seen[(i + 1) % 3]; seen[i % 3] += 0.1; if (d < 1e-3) break; t += 0.5 "
          "* d; "
          "}"}) {
        const Function function = marcher("length(p) - 1.0", march);
        const auto loops = find_marching_loops(function);
        ASSERT_EQ(loops.size(), 1u) << march;
        FloatEvaluator evaluator = entered(function, loops, 0);
        const FloatEvaluator at_entry = evaluator;
        const March followed = follow(evaluator, function, loops[0]);
        EXPECT_FALSE(is_faithful(slice_of(function, loops[0]), at_entry, followed)) << march;
    }
}

} // namespace tidemark::proof::marching_loop_test
