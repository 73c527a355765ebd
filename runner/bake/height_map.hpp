// Heights above the sea at the nodes of a square grid: what the shore, the marching and the baked fields are
// all read from.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tidemark::bake {

/// Metres; x to the east, y to the north, (0,0) the middle of the map.
struct Point {
    double x = 0.0;
    double y = 0.0;
};

inline double length(Point p) {
    return std::sqrt(p.x * p.x +
                     p.y * p.y); // std::hypot's last bit is the library's, a root's is the standard's
}

inline double distance(Point a, Point b) {
    return length({a.x - b.x, a.y - b.y});
}

/// `side` nodes a side, rows from the south; a node stands in the middle of its texel. Below 0 is water.
struct HeightMap {
    int side = 0;
    double extent = 0.0; ///< metres from edge to edge of the outermost texels
    std::vector<double> heights;

    HeightMap(int nodes_a_side, double metres)
        : side(nodes_a_side), extent(metres), heights(size_t(nodes_a_side) * size_t(nodes_a_side)) {}

    double spacing() const { return extent / side; }
    int node(int x, int y) const { return y * side + x; }
    Point position(int node) const { return {coordinate(node % side), coordinate(node / side)}; }
    bool is_water(int node) const { return heights[size_t(node)] < 0.0; }

private:
    double coordinate(int i) const { return (i + 0.5) * spacing() - 0.5 * extent; }
};

} // namespace tidemark::bake
