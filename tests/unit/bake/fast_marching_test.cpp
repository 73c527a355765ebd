#include "bake/fast_marching.hpp"
#include "bake/fast_marching_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::bake::fast_marching_test {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

const KnownCase& case_named(std::string_view name) {
    return *std::find_if(known_cases().begin(), known_cases().end(),
                         [&](const KnownCase& known) { return known.name == name; });
}

/// The power of the spacing that the error falls with from 64 to 512 nodes a side, 3 halvings.
struct Orders {
    double smooth_rms, smooth_largest, rest_rms, rest_largest;
};

Orders orders_of(std::string_view name, Stencil stencil) {
    const MarchSample coarse = study_march(case_named(name), 64, stencil);
    const MarchSample fine = study_march(case_named(name), 512, stencil);
    const auto order = [](double from, double to) { return std::log2(from / to) / 3.0; };
    return {order(coarse.errors[0].rms, fine.errors[0].rms),
            order(coarse.errors[0].largest, fine.errors[0].largest),
            order(coarse.errors[1].rms, fine.errors[1].rms),
            order(coarse.errors[1].largest, fine.errors[1].largest)};
}

/// All water of depth 1 but where `land` says so.
template <class Land>
HeightMap map_with(int side, const Land& land) {
    HeightMap map(side, double(side)); // a spacing of 1
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            map.heights[size_t(map.node(x, y))] = land(x, y) ? 1.0 : -1.0;
    return map;
}

std::vector<double> known_at(const HeightMap& map, int x, int y) {
    std::vector<double> known(map.heights.size(), k_nan);
    known[size_t(map.node(x, y))] = 0.0;
    return known;
}

TEST(FastMarch, error_has_second_order_where_distances_are_smooth) {
    for (const KnownCase& known : known_cases()) {
        const Orders orders = orders_of(known.name, Stencil::second_order);
        EXPECT_GT(orders.smooth_rms, 1.8) << known.name;
        EXPECT_GT(orders.smooth_largest, 1.65) << known.name;
    }
}

TEST(FastMarch, error_has_first_order_after_land_and_where_fronts_meet) {
    for (const KnownCase& known : known_cases()) {
        const Orders orders = orders_of(known.name, Stencil::second_order);
        EXPECT_GT(orders.rest_largest, 0.9) << known.name;
        EXPECT_GT(orders.rest_rms, 0.85) << known.name;
    }
}

TEST(FastMarch, first_order_stencil_has_first_order) {
    const Orders orders = orders_of("open", Stencil::first_order);
    EXPECT_NEAR(orders.smooth_rms, 0.95, 0.1);
}

// Measured 2.7e-5, 1.4e-4 and 5.8e-4 of the radius; with a staircase in the shore polygons' place the last
// two are 1.8e-3 and 4.7e-3.
TEST(FastMarch, error_at_256_nodes_per_side_is_bounded) {
    for (const auto& [name, smooth, rest] :
         {std::tuple{"open", 3.5e-5, 4.5e-4}, {"disc", 3.5e-5, 1.7e-4}, {"gap", 1.5e-5, 7e-4}}) {
        const MarchSample sample = study_march(case_named(name), 256, Stencil::second_order);
        EXPECT_LT(sample.errors[0].rms, smooth) << name;
        EXPECT_LT(sample.errors[1].rms, rest) << name;
        EXPECT_GT(sample.errors[1].rms, 0.0) << name;
    }
}

TEST(FastMarch, work_is_proportional_to_the_nodes) {
    for (const KnownCase& known : known_cases())
        for (const int side : {64, 512}) {
            const MarchSample sample = study_march(known, side, Stencil::second_order);
            EXPECT_LT(double(sample.work.updates), 2.0 * side * side) << known.name;
            EXPECT_LT(double(sample.work.heap_operations), 3.0 * side * side) << known.name;
        }
}

TEST(FastMarch, slope_is_1_where_distances_are_smooth) {
    const KnownCase& known = case_named("disc");
    const HeightMap map = map_of(known, 256);
    const auto distances = fast_march(map, known_from_circle(map, 1.0)).of_node;
    size_t judged = 0;
    for (int y = 1; y < 255; ++y)
        for (int x = 1; x < 255; ++x) {
            const int node = map.node(x, y);
            if (length(map.position(node)) > 0.97 || !map.is_water(node) ||
                known.region(map.position(node)) != Region::smooth)
                continue;
            const auto slope = [&](int step) {
                return (distances[size_t(node + step)] - distances[size_t(node - step)]) /
                       (2.0 * map.spacing());
            };
            EXPECT_NEAR(std::hypot(slope(1), slope(256)), 1.0, 0.02) << x << ' ' << y;
            ++judged;
        }
    EXPECT_GT(judged, 10000U);
}

TEST(FastMarch, exact_along_axes_and_for_a_plane_front) {
    const HeightMap map = map_with(64, [](int, int) { return false; });
    std::vector<double> known(map.heights.size(), k_nan);
    // x + 2 y, scaled to a slope of 1, given on two sides.
    const auto plane = [&](int x, int y) { return (x + 2.0 * y) / std::sqrt(5.0); };
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 2; ++j) {
            known[size_t(map.node(i, j))] = plane(i, j);
            known[size_t(map.node(j, i))] = plane(j, i);
        }
    for (const Stencil stencil : {Stencil::first_order, Stencil::second_order}) {
        const auto distances = fast_march(map, known, stencil).of_node;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                EXPECT_NEAR(distances[size_t(map.node(x, y))], plane(x, y), 1e-11) << x << ' ' << y;
    }
}

TEST(FastMarch, mirrored_and_rotated_maps_have_mirrored_and_rotated_distances) {
    // A spacing of 1/32: coordinates are exact, so that symmetric nodes get the same arithmetic.
    HeightMap map(64, 2.0), turned(64, 2.0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const Point p = map.position(map.node(x, y));
            const double height = 0.3 - distance(p, {0.3, 0.1});
            map.heights[size_t(map.node(x, y))] = height;
            turned.heights[size_t(map.node(63 - y, x))] = height;
        }
    const auto a = fast_march(map, known_from_circle(map, 0.9)).of_node;
    const auto b = fast_march(turned, known_from_circle(turned, 0.9)).of_node;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double left = a[size_t(map.node(x, y))], right = b[size_t(map.node(63 - y, x))];
            if (std::isinf(left))
                EXPECT_TRUE(std::isinf(right)) << x << ' ' << y;
            else
                EXPECT_NEAR(left, right, 1e-12) << x << ' ' << y;
        }
}

TEST(FastMarch, land_and_lakes_are_not_reached) {
    const HeightMap map =
        map_with(32, [](int x, int y) { return std::max(std::abs(x - 15), std::abs(y - 15)) == 5; });
    const auto distances = fast_march(map, known_at(map, 0, 0)).of_node;
    EXPECT_TRUE(std::isinf(distances[size_t(map.node(10, 15))])); // wall
    EXPECT_TRUE(std::isinf(distances[size_t(map.node(15, 15))])); // lake
    EXPECT_TRUE(std::isfinite(distances[size_t(map.node(31, 31))]));
}

TEST(FastMarch, follows_the_walls_of_a_channel) {
    // Walls one node thick with gaps at alternate ends: 3 turns. Heights of 1 and -1 put the shore half-way
    // between nodes, so that a wall's end is cut off by a quarter of a spacing at each corner.
    const HeightMap map = map_with(
        41, [](int x, int y) { return y % 10 == 0 && y > 0 && y < 40 && (y % 20 == 10 ? x < 38 : x > 2); });
    const auto distances = fast_march(map, known_at(map, 0, 5)).of_node;
    const double reached = distances[size_t(map.node(40, 35))];
    // Straight lines between the ends of the walls, taken at the rim of the gaps.
    const double shortest = std::hypot(37.5, 4.5) + 1.0 + std::hypot(35.0, 9.0) + 1.0 +
                            std::hypot(35.0, 9.0) + 1.0 + std::hypot(2.5, 4.5);
    EXPECT_NEAR(reached, shortest, 0.03 * shortest);
    EXPECT_GT(distances[size_t(map.node(0, 15))], std::hypot(37.5, 4.5) + std::hypot(37.5, 4.5));
}

TEST(FastMarch, touching_corners_of_land_block_the_front) {
    // Land along a diagonal, one node a row.
    const HeightMap map = map_with(32, [](int x, int y) { return x == y; });
    const auto distances = fast_march(map, known_at(map, 31, 0)).of_node;
    EXPECT_TRUE(std::isinf(distances[size_t(map.node(0, 31))]));
    EXPECT_TRUE(std::isfinite(distances[size_t(map.node(31, 30))]));
}

TEST(FastMarch, along_a_slanting_shore_is_as_long_as_the_shore) {
    // Land above a line of slope 3/7, through no node; a way along it from end to end. Over cells it would be
    // a staircase up to 1.3 times as long.
    HeightMap map(128, 128.0);
    for (int node = 0; node < 128 * 128; ++node) {
        const Point p = map.position(node);
        map.heights[size_t(node)] = (p.y - 0.13 - 3.0 / 7.0 * p.x) / 10.0;
    }
    std::vector<double> known(map.heights.size(), k_nan);
    const auto just_below = [&](int x) {
        int y = 0;
        while (map.is_water(map.node(x, y + 1)))
            ++y;
        return map.node(x, y);
    };
    const int from = just_below(4), to = just_below(123);
    known[size_t(from)] = 0.0;
    const double straight = distance(map.position(from), map.position(to));
    const double way = fast_march(map, known).of_node[size_t(to)];
    EXPECT_GE(way, straight - 1e-9);
    EXPECT_LT(way, 1.005 * straight);
}

TEST(FastMarch, more_land_never_shortens_a_distance) {
    const auto less = [](int x, int y) { return (x - 20) * (x - 20) + (y - 20) * (y - 20) < 50; };
    const auto more = [&](int x, int y) { return less(x, y) || (x == 30 && y > 8); };
    const HeightMap open = map_with(48, less), walled = map_with(48, more);
    const auto a = fast_march(open, known_at(open, 2, 3), Stencil::first_order).of_node;
    const auto b = fast_march(walled, known_at(walled, 2, 3), Stencil::first_order).of_node;
    for (size_t node = 0; node < a.size(); ++node)
        if (std::isfinite(b[node])) {
            EXPECT_LE(a[node], b[node] + 1e-9);
        }
    EXPECT_GT(b[size_t(walled.node(40, 40))], a[size_t(open.node(40, 40))] + 5.0);
}

TEST(KnownFromCircle, is_exact_outside_and_two_nodes_deep_inside) {
    const HeightMap map = map_with(64, [](int, int) { return false; });
    const auto known = known_from_circle(map, 28.0);
    for (int node = 0; node < 64 * 64; ++node) {
        const double straight = 28.0 - length(map.position(node));
        if (straight < 2.5)
            EXPECT_EQ(known[size_t(node)], straight);
        else
            EXPECT_TRUE(std::isnan(known[size_t(node)]));
    }
}

// The exact answers themselves: they meet at the edges of the regions they are put together from, and no two
// neighbours are further apart than the way between them.
// (Half a per cent: a corner of the ring may stand between two nodes.)
TEST(KnownCases, are_continuous) {
    for (const KnownCase& known : known_cases()) {
        const HeightMap map = map_of(known, 200);
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x + 1 < 200; ++x) {
                const int a = map.node(x, y), b = map.node(x + 1, y);
                if (!map.is_water(a) || !map.is_water(b) || length(map.position(a)) >= 1.0 ||
                    length(map.position(b)) >= 1.0)
                    continue;
                EXPECT_LE(std::abs(known.exact(map.position(a)) - known.exact(map.position(b))),
                          1.005 * map.spacing())
                    << known.name << ' ' << x << ' ' << y;
            }
    }
}

} // namespace tidemark::bake::fast_marching_test
