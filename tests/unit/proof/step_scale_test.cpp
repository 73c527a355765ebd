// Fields whose longest safe step is known by hand.
#include "ir_support.hpp"
#include "proof/ray_proofs.hpp"

#include <cmath>

namespace tidemark::proof::step_scale_test {

StepScale scale_of(const std::string& field, float x, uint64_t most = 2'000) {
    const Function function = marcher(field, k_sphere_tracing);
    const auto loops = find_marching_loops(function);
    EXPECT_EQ(loops.size(), 1u) << field;
    const LoopSlice turn = slice_of(function, loops.at(0));
    MarchSlice slice(turn, entered(function, loops, x), {}, Surface::zero);
    const FirstHit hit = first_hit(slice, 20);
    EXPECT_EQ(hit.verdict, FirstHit::Verdict::hit) << to_string(hit.reason);
    return step_scale(slice, hit.where, most);
}

void expect_scale(const StepScale& scale, double exact) {
    EXPECT_LE(scale.safe, exact * (1 + 1e-4));
    EXPECT_GE(scale.safe, exact * 0.94);
    EXPECT_GE(scale.unsafe, exact * (1 - 1e-4));
    EXPECT_LE(scale.unsafe, exact * 1.06);
}

TEST(StepScale, of_a_distance_is_1_and_of_others_the_inverse_slope) {
    expect_scale(scale_of("length(p) - 1.0", 0), 1);
    expect_scale(scale_of("2.0 * (length(p) - 1.0)", 0), 0.5);
    expect_scale(scale_of("0.4 * (length(p) - 1.0)", 0), 2.5);
}

TEST(StepScale, is_that_of_the_worst_place) {
    // From 1.5 to 1 before the hit the field is three times the distance.
    expect_scale(scale_of("(p.z < 0.5 || p.z > 1.0 ? 1.0 : 3.0) * (2.0 - p.z)", 0), 1.0 / 3);
    expect_scale(scale_of("(p.z < -2.5 ? 9.0 : 1.0) * (2.0 - p.z)", 0), 1.0 / 9);
}

TEST(StepScale, holds_on_a_ray_that_passes_a_crest) {
    const StepScale scale = scale_of("2.0 - p.z + 0.4 * sin(5.0 * p.z)", 0, 5'000);
    double least = k_infinity, hit = 0;
    const auto field = [](double z) { return 2.0 - z + 0.4 * std::sin(5.0 * z); };
    for (double z = -3; hit == 0; z += 1e-5)
        if (field(z) < 0)
            hit = z;
    for (double z = -3; field(z) > 0.001; z += 1e-4)
        least = std::min(least, (hit - z) / field(z));
    EXPECT_LE(scale.safe, least * (1 + 1e-4));
    EXPECT_GE(scale.safe, least * 0.9);
    EXPECT_GE(scale.unsafe, least * (1 - 1e-3));
}

TEST(StepScale, is_0_for_unbounded_fields) {
    const StepScale scale = scale_of("p.z < 0.0 ? (2.0 - p.z) / abs(p.z + 1.0) : 2.0 - p.z", 0);
    EXPECT_EQ(scale.safe, 0);
}

} // namespace tidemark::proof::step_scale_test
