// Fields whose first root is known by hand.
#include "ir_support.hpp"
#include "proof/ray_proofs.hpp"

#include <cmath>

namespace tidemark::proof::first_hit_test {

using Verdict = FirstHit::Verdict;

FirstHit hit_of(const std::string& field, float x, double last = 20,
                const std::string& march = k_sphere_tracing) {
    const Function function = marcher(field, march);
    const auto loops = find_marching_loops(function);
    EXPECT_EQ(loops.size(), 1u) << field;
    const LoopSlice turn = slice_of(function, loops.at(0));
    MarchSlice slice(turn, entered(function, loops, x), [](const Lookup&, std::span<const Interval>) {
        return Interval{0, 1};
    });
    return first_hit(slice, last);
}

void expect_hit(const FirstHit& hit, double where) {
    EXPECT_EQ(hit.verdict, Verdict::hit) << to_string(hit.reason);
    EXPECT_LE(hit.where.low, where + 1e-6);
    EXPECT_GE(hit.where.high, where - 1e-6);
    EXPECT_LT(hit.where.width(), 1e-2 * where);
}

TEST(FirstHit, of_a_sphere_is_at_the_threshold_distance) {
    expect_hit(hit_of("length(p) - 1.0", 0), 3 - 1.001);
    expect_hit(hit_of("length(p) - 1.0", 0.6f), 3 - std::sqrt(1.001 * 1.001 - 0.36));
    const FirstHit beside = hit_of("length(p) - 1.0", 1.5f);
    EXPECT_EQ(beside.verdict, Verdict::none);
    EXPECT_EQ(beside.where.high, 20);
}

TEST(FirstHit, is_found_if_the_distance_depends_on_an_index) {
    expect_hit(hit_of("length(p) - 1.0", 0, 20,
                      "for (int i = 0; i < 99; ++i) { vec3 p = ro + rd * t, q = p;\n"
                      "for (int k = 0; k < 3; ++k) q[k] = abs(p[(k + 1) % 3]);\n"
                      "float d = map(q); if (d < 1e-3) break; t += d; }"),
               3 - 1.001);
}

TEST(FirstHit, is_found_even_if_the_march_oversteps) {
    // A thin sheet, a step of 0.5 beyond it.
    const std::string march =
        "for (int i = 0; i < 40; ++i) { t += 0.5; if (map(ro + rd * t) < 0.0) break; if (t > 19.0) break; }";
    expect_hit(hit_of("min(abs(p.z + 2.2) - 0.01, 5.0 - p.z)", 0, 20, march), 0.79);
}

TEST(FirstHit, is_found_after_jumps_of_a_repeated_space) {
    // Between the cells, at a way of 1, it falls from 2.5 to 0.5.
    expect_hit(hit_of("length(vec3(p.xy, mod(p.z - 2.0, 4.0) - 1.0)) - 0.5", 0), 2 - 0.501);
    expect_hit(hit_of("p.z < 1.5 ? 1.0 : max(3.0 - p.z, -9.0)", 0), 6 - 0.001);
}

TEST(FirstHit, with_noise_of_lattice_points_is_decided) {
    const FirstHit hit =
        hit_of("p.z - 2.0 + 0.3 * mix(fract(sin(floor(p.z) * 91.7) * 4311.3),\n"
               "fract(sin((floor(p.z) + 1.0) * 91.7) * 4311.3), fract(p.z)) < 0.0 ? 1.0 : -1.0",
               0);
    EXPECT_EQ(hit.verdict, Verdict::hit) << to_string(hit.reason);
    EXPECT_GT(hit.where.low, 4.6);
    EXPECT_LT(hit.where.high, 5.1);
}

TEST(FirstHit, with_lattice_points_that_are_a_difference_is_decided) {
    const FirstHit hit = hit_of("p.z - 2.0 + 0.3 * fract(sin((p.z - fract(p.z)) * 91.7) * 4311.3)", 0);
    EXPECT_EQ(hit.verdict, Verdict::hit) << to_string(hit.reason);
    EXPECT_LT(hit.where.width(), 1e-3);
}

/// At the start the lattice's plane itself belongs to another cell than all points beyond it.
TEST(FirstHit, is_decided_even_if_the_ray_starts_at_a_jump) {
    const FirstHit hit =
        hit_of("5.0 + p.z + 0.3 * fract(sin(floor(-p.z) * 91.7) * 4311.3)", 0, 20,
               "for (int i = 0; i < 100; ++i) { float d = map(ro - rd * t); if (d < 0.001 || t > "
               "20.0) break; t += 0.5 * d; }");
    EXPECT_EQ(hit.verdict, Verdict::hit) << to_string(hit.reason);
    EXPECT_GT(hit.where.low, 1.9);
    EXPECT_LT(hit.where.width(), 1e-3);
}

TEST(FirstHit, is_found_after_the_cut_of_an_angle_and_with_round) {
    // At a way of 4 the angle jumps from pi to -pi.
    expect_hit(hit_of("min(5.0 - p.z, abs(atan(1.0 - p.z, -1.0)) - 1.0)", 0), 8 - 0.001);
    expect_hit(hit_of("length(vec3(p.xy, p.z - 0.5 - 4.0 * round((p.z - 0.5) / 4.0))) - 0.5", 0.25f),
               3.5 - std::sqrt(0.501 * 0.501 - 0.0625));
}

TEST(FirstHit, uses_the_strictness_of_the_comparison_in_the_text) {
    const std::string march = "for (int i = 0; i < 100; ++i) { float d = map(ro + rd * t);"
                              "if (d LEAVES 0.5 || t > 20.0) break; t += 0.1 * d; }";
    const auto leaves = [&](const char* how) {
        std::string text = march;
        return hit_of("max(3.0 - p.z, p.z < 4.0 ? 0.5 : 3.0 - p.z)", 0, 20,
                      text.replace(text.find("LEAVES"), 6, how));
    };
    expect_hit(leaves("<"), 7);
    expect_hit(leaves("<="), 5.5);
}

TEST(FirstHit, nan_fields_have_no_hit) {
    // NaN up to z = 1: no comparison holds there, and none ends the march.
    expect_hit(hit_of("5.0 - p.z + 0.0 * sqrt(p.z - 1.0)", 0), 8 - 0.001);
    const std::string march =
        "for (int i = 0; i < 100; ++i) { float d = map(ro + rd * t); if (!(d > 0.001)) break; t += 0.1; }";
    const FirstHit left = hit_of("5.0 - p.z + 0.0 * sqrt(p.z - 1.0)", 0, 20, march);
    EXPECT_EQ(left.verdict, Verdict::undecided);
    EXPECT_EQ(left.reason, FirstHit::Reason::not_finite);
}

TEST(FirstHit, of_a_pole_is_at_minus_infinity) {
    expect_hit(hit_of("1.0 / (1.0 - p.z)", 0), 4);
}

TEST(FirstHit, is_narrow_however_long_the_ray_is) {
    const FirstHit hit = hit_of("length(p) - 1.0", 0, 1e9);
    expect_hit(hit, 3 - 1.001);
}

TEST(FirstHit, of_a_ray_starting_below_the_surface_is_its_start) {
    const FirstHit inside = hit_of("p.z + 3.0 > 0.5 ? 1.0 : -2.0", 0, 0);
    EXPECT_EQ(inside.verdict, Verdict::hit);
    EXPECT_EQ(inside.where.high, 0);
    EXPECT_EQ(hit_of("length(p) - 1.0", 0, 0).verdict, Verdict::none);
}

/// A march that begins at NaN or at an infinity proves nothing: it has no place to begin with.
TEST(FirstHit, of_a_ray_with_a_non_finite_start_is_undecided) {
    for (const char* start : {"0.0 / iTime", "1.0 / iTime", "-1.0 / iTime"}) {
        const FirstHit hit =
            hit_of("length(p) - 1.0", 0, 20, "t = " + std::string(start) + ";" + k_sphere_tracing);
        EXPECT_EQ(hit.verdict, Verdict::undecided) << start;
        EXPECT_EQ(hit.reason, FirstHit::Reason::not_finite) << start;
        EXPECT_EQ(hit.where.low, -k_infinity) << start;
    }
    EXPECT_EQ(hit_of("length(p) - 1.0", 1.5f, k_infinity).verdict, Verdict::undecided);
}

/// Unless something ends it, the march goes on until its place is infinite or NaN.
TEST(FirstHit, is_searched_up_to_the_last_finite_place) {
    const Function function =
        marcher("length(p) - 1.0", "for (int i = 0; i < 200; ++i) { float d = map(ro + rd * t);"
                                   "if (d < 0.001) break; t += d; }");
    const auto loops = find_marching_loops(function);
    ASSERT_EQ(loops.size(), 1u);
    FloatEvaluator evaluator = entered(function, loops, 1.5f);
    const LoopSlice turn = slice_of(function, loops[0]);
    MarchSlice slice(turn, evaluator);
    const March march = follow(evaluator, function, loops[0]);
    EXPECT_FALSE(std::isfinite(march.turns.back().carried[0]));
    EXPECT_TRUE(std::isfinite(slice.end(march)));
    EXPECT_EQ(first_hit(slice, slice.end(march)).verdict, Verdict::none);
}

TEST(FirstHit, is_undecided_for_grazing_rays_and_unknown_fields) {
    const FirstHit grazing = hit_of("length(p) - 1.0", 1.001f);
    EXPECT_NE(grazing.verdict, Verdict::hit);
    const FirstHit unknown = hit_of("texture(iChannel0, p.xz).r - 0.5", 0);
    EXPECT_EQ(unknown.verdict, Verdict::undecided);
    EXPECT_EQ(unknown.where.low, 0);
}

} // namespace tidemark::proof::first_hit_test
