// Heights above sea level at the nodes of a square grid: the input of the shore, the marching and the baked
// fields.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
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

// Splits the grid cells that the shoreline cuts into convex polygons of water, whose corners are nodes and
// crossings of the shore with grid lines. With them a path along the shore has the shore's own length instead
// of that of a staircase.

/// Corners in order around the polygon; a number below side² is a node of the map, others are crossings.
struct WaterPolygon {
    std::array<int, 5> corners{};
    int size = 0;
};

/// The polygons of a map, by marching squares. A crossing is where the height, linear along the grid line, is
/// 0: for a curved shore its distance from the true one is O(spacing²). Where two opposite corners of a cell
/// are land, the land is taken to connect.
class ShoreCells {
public:
    explicit ShoreCells(const HeightMap& map);

    int vertices() const { return int(nodes_ + crossings_.size()); }
    const std::vector<Point>& crossings() const { return crossings_; }

    /// Returns the polygons that have `vertex` as a corner.
    std::span<const int> polygons_at(int vertex) const {
        const auto first = size_t(first_[size_t(vertex)]);
        return std::span(incidence_).subspan(first, size_t(first_[size_t(vertex) + 1]) - first);
    }
    const WaterPolygon& polygon(int index) const { return polygons_[size_t(index)]; }

private:
    void index_polygons();

    size_t nodes_;
    std::vector<Point> crossings_;
    std::vector<WaterPolygon> polygons_;
    std::vector<int> first_; ///< index of each vertex in incidence_, plus one entry for the end
    std::vector<int> incidence_;
};

// Computes the lengths of shortest paths over water: solves the eikonal equation |grad u| = 1 outwards from
// nodes with known u, in one pass (J. A. Sethian, "A fast marching level set method for monotonically
// advancing fronts", 1996). Independent of waves and pictures.

/// Order of the differences. The second order needs two known nodes in a row; otherwise the first is used.
enum class Stencil { first_order = 1, second_order = 2 };

struct Distances {
    std::vector<double> of_node; ///< metres; infinite on land and where water does not lead
    size_t updates = 0;          ///< local solutions, a measure of the work
    size_t heap_operations = 0;  ///< pushes and pops
};

/// Marches from `known`, which holds u where it is known and NaN elsewhere; known nodes on land are ignored.
///
/// Where u is smooth along a whole path, the differences are of the second order, and so is the error: O(h²).
/// Where paths fan out or meet (a corner that waves bend round, the edge of a shadow, the centre of a closing
/// circle), u has no bounded third derivative: O(h log 1/h) is proved for the first-order scheme there (H.
/// Zhao, "A fast sweeping method for eikonal equations", 2005), and about the first order is measured
/// (fast_marching_study.hpp). At the shore each polygon of ShoreCells is solved by the Hopf-Lax formula: u(v)
/// = min over its far edges of (u, linear along the edge, + the distance to v), as on triangles (R. Kimmel
/// and J. A. Sethian, "Computing geodesic paths on manifolds", 1998). It is monotone, O(h), and adds nothing
/// to a path along the shore. A polygon may be obtuse at a crossing, so that a vertex can be accepted after
/// one whose value depends on it: it then corrects that one, until no correction is left.
Distances fast_march(const HeightMap& map, std::span<const double> known,
                     Stencil stencil = Stencil::second_order);

/// Returns the known values of waves that start on the circle of `radius` metres around the centre and run
/// inwards: the exact distance from it, below 0 outside, at every node that is outside or less than 2.5
/// spacings inside. Both nodes of a second-order difference are therefore exact where the march begins.
std::vector<double> known_from_circle(const HeightMap& map, double radius);

} // namespace tidemark::bake
