// The march with a proof against one in small steps, for the tests of the fields.
#pragma once

#include "fields/certified_march.hpp"

#include <gtest/gtest.h>

namespace tidemark::fields {

/// Expects the two to agree on one ray; whether they meet something. A dense march may step over a crest,
/// never the other way round.
inline bool expect_as_dense(const Field& field, const Ray& ray, RayRange range, double step) {
    const double found = certified_march(field, ray, range).distance;
    double dense = -1;
    for (double t = range.near; t <= range.far && dense < 0; t += step)
        dense = field.value(ray.at(t)) < 0 ? t : -1;
    if (dense < 0) {
        EXPECT_TRUE(found < 0 || field.value(ray.at(found + 1e-6)) < 0);
        return false;
    }
    EXPECT_LE(found, dense);
    EXPECT_GT(found, dense - step) << "or a crest thinner than the dense step";
    EXPECT_NEAR(field.value(ray.at(found)), 0, 1e-12);
    return true;
}

} // namespace tidemark::fields
