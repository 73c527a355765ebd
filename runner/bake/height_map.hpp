// Heights above sea level at the nodes of a square grid: the input of the shore, the marching and the baked
// fields.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tidemark::bake {

/// Position in metres; x to the east, y to the north, (0,0) at the centre of the map.
struct Point {
    double x = 0.0;
    double y = 0.0;
};

inline double length(Point p) {
    return std::sqrt(p.x * p.x +
                     p.y * p.y); // std::hypot's last bit depends on the library, a root's is standard
}

inline double distance(Point a, Point b) {
    return length({a.x - b.x, a.y - b.y});
}

/// Square grid of `side` x `side` nodes, rows from the south; a node is at the centre of its texel. Below 0
/// is water.
struct HeightMap {
    int side = 0;
    double extent = 0.0; ///< metres between the outer edges of the outermost texels
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
