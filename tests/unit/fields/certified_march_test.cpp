#include "fields/certified_march.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::fields::certified_march_test {

/// A ball of radius 1 under a lid at y = 1: distance is exact, so is the clearance.
Field ball(const glm::dvec3& centre) {
    const auto value = [=](const glm::dvec3& p) { return glm::distance(p, centre) - 1.0; };
    return {[=](const glm::dvec3& p, const glm::dvec3&) {
                return FieldSample{value(p), std::abs(value(p))};
            },
            value, centre.y - 1, centre.y + 1, 1.0};
}

Ray towards(const glm::dvec3& from, const glm::dvec3& to) {
    return {from, glm::normalize(to - from)};
}

TEST(CertifiedMarch, HitsABallAtTheExactDistance) {
    const Field field = ball({0, 0, 0});
    const CertifiedHit hit = certified_march(field, towards({0, 5, 0}, {0, 0, 0}), {0, 100});
    EXPECT_NEAR(hit.distance, 4.0, 1e-15);
    EXPECT_FALSE(hit.started_inside);

    // Off the centre by 0.6: half a chord of 0.8 before the foot of the perpendicular.
    const CertifiedHit aside = certified_march(field, {{0.6, 5, 0}, {0, -1, 0}}, {0, 100});
    EXPECT_NEAR(aside.distance, 5 - 0.8, 1e-14);
}

TEST(CertifiedMarch, MissesWhereTheRayPassesBy) {
    const Field field = ball({0, 0, 0});
    EXPECT_EQ(certified_march(field, {{1.001, 5, 0}, {0, -1, 0}}, {0, 100}).distance, -1);
    EXPECT_EQ(certified_march(field, towards({0, 5, 0}, {0, 0, 0}), {0, 3.9}).distance, -1);
    EXPECT_EQ(certified_march(field, {{0, 5, 0}, {0, 1, 0}}, {0, 1e9}).samples, 0);
    EXPECT_EQ(certified_march(field, {{0, 1.5, -9}, {0, 0, 1}}, {0, 1e9}).samples, 0);
}

TEST(CertifiedMarch, FindsAContactLongerThanItsShortestStep) {
    // The inside of the ball along a ray at 1 - d from the centre is 2 sqrt(2 d) long: 2e-3 here.
    const Field field = ball({0, 0, 0});
    const CertifiedHit hit = certified_march(field, {{1 - 5e-7, 5, 0}, {0, -1, 0}}, {0, 100});
    EXPECT_NEAR(hit.distance, 5 - 1e-3, 1e-6);
}

TEST(CertifiedMarch, ReportsAStartInside) {
    const Field field = ball({0, 0, 0});
    const CertifiedHit hit = certified_march(field, {{0, 0, 0}, {0, 1, 0}}, {0.5, 100});
    EXPECT_TRUE(hit.started_inside);
    EXPECT_EQ(hit.distance, 0.5);
    const CertifiedHit below = certified_march(field, {{0, -7, 0}, {0, -1, 0}}, {0.25, 100});
    EXPECT_EQ(below.samples, 1); // below the lowest zero all is inside; the ball alone would not say so
}

TEST(CertifiedMarch, StopsAtNan) {
    Field field = ball({0, 0, 0});
    field.sample = [](const glm::dvec3&, const glm::dvec3&) { return FieldSample{NAN, NAN}; };
    EXPECT_TRUE(std::isnan(certified_march(field, {{0, 0.9, 0}, {0, -1, 0}}, {0, 100}).distance));
}

TEST(ClipToSlab, KeepsOnlyThePartThatCanContainAZero) {
    const Field field = ball({0, 0, 0});
    const RayRange down = clip_to_slab(field, {{0, 5, 0}, {0, -1, 0}}, {0.1, 100});
    EXPECT_NEAR(down.near, 4, 1e-8);
    EXPECT_NEAR(down.far, 6, 1e-8);
    const RayRange up = clip_to_slab(field, {{0, 0, 0}, {0, 1, 0}}, {0.1, 100});
    EXPECT_DOUBLE_EQ(up.near, 0.1);
    EXPECT_NEAR(up.far, 1, 1e-8);
    const RayRange above = clip_to_slab(field, {{0, 5, 0}, {1, 0, 0}}, {0.1, 100});
    EXPECT_GT(above.near, above.far);
}

} // namespace tidemark::fields::certified_march_test
