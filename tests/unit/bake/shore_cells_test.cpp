#include "bake/fast_marching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace tidemark::bake::shore_cells_test {

HeightMap disc_map(int side) {
    HeightMap map(side, 2.0);
    for (int node = 0; node < side * side; ++node)
        map.heights[size_t(node)] = 0.61 - distance(map.position(node), {0.03, -0.07});
    return map;
}

std::vector<Point> corners_of(const HeightMap& map, const ShoreCells& shore, const WaterPolygon& polygon) {
    std::vector<Point> points;
    for (int i = 0; i < polygon.size; ++i) {
        const auto corner = size_t(polygon.corners[size_t(i)]);
        points.push_back(corner < map.heights.size() ? map.position(int(corner))
                                                     : shore.crossings()[corner - map.heights.size()]);
    }
    return points;
}

double turn(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

std::set<int> polygons_of(const ShoreCells& shore) {
    std::set<int> all;
    for (int vertex = 0; vertex < shore.vertices(); ++vertex)
        for (const int polygon : shore.polygons_at(vertex))
            all.insert(polygon);
    return all;
}

double shore_area(const HeightMap& map) {
    const ShoreCells shore(map);
    double area = 0.0;
    for (const int index : polygons_of(shore)) {
        const auto points = corners_of(map, shore, shore.polygon(index));
        for (size_t i = 1; i + 1 < points.size(); ++i)
            area += 0.5 * turn(points[0], points[i], points[i + 1]);
    }
    for (int y = 0; y + 1 < map.side; ++y)
        for (int x = 0; x + 1 < map.side; ++x) {
            const int node = map.node(x, y);
            if (map.is_water(node) && map.is_water(node + 1) && map.is_water(node + map.side) &&
                map.is_water(node + map.side + 1))
                area += map.spacing() * map.spacing();
        }
    return area;
}

TEST(ShoreCells, polygons_are_convex_and_counterclockwise) {
    const HeightMap map = disc_map(64);
    const ShoreCells shore(map);
    for (const int index : polygons_of(shore)) {
        const auto points = corners_of(map, shore, shore.polygon(index));
        ASSERT_GE(points.size(), 3U);
        for (size_t i = 0; i < points.size(); ++i)
            EXPECT_GE(turn(points[i], points[(i + 1) % points.size()], points[(i + 2) % points.size()]),
                      -1e-15);
    }
}

TEST(ShoreCells, crossings_have_an_error_of_second_order) {
    for (const int side : {64, 256}) {
        const HeightMap map = disc_map(side);
        const ShoreCells shore(map);
        for (const Point crossing : shore.crossings())
            EXPECT_NEAR(distance(crossing, {0.03, -0.07}), 0.61, 0.5 * map.spacing() * map.spacing());
    }
}

TEST(ShoreCells, area_of_water_has_an_error_of_second_order) {
    for (const int side : {64, 128, 256}) {
        const double between = 2.0 - 2.0 / side; // from the first node to the last
        const double exact = between * between - std::numbers::pi * 0.61 * 0.61;
        EXPECT_NEAR(shore_area(disc_map(side)), exact, 2.0 * std::pow(2.0 / side, 2)) << side;
    }
}

TEST(ShoreCells, open_water_has_no_shore) {
    HeightMap map(8, 8.0);
    for (double& height : map.heights)
        height = -1.0;
    const ShoreCells shore(map);
    EXPECT_EQ(shore.vertices(), 64);
    EXPECT_TRUE(polygons_of(shore).empty());
}

TEST(ShoreCells, opposite_corners_of_water_stay_separate) {
    HeightMap map(2, 2.0);
    map.heights = {-1.0, 1.0, 1.0, -1.0};
    const ShoreCells shore(map);
    EXPECT_EQ(shore.crossings().size(), 4U);
    ASSERT_EQ(polygons_of(shore).size(), 2U);
    EXPECT_EQ(shore.polygons_at(0).size(), 1U);
    EXPECT_EQ(shore.polygons_at(3).size(), 1U);
    EXPECT_NE(shore.polygons_at(0)[0], shore.polygons_at(3)[0]);
}

} // namespace tidemark::bake::shore_cells_test
