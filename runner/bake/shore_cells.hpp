// Splits the grid cells that the shoreline cuts into convex polygons of water, whose corners are nodes and
// crossings of the shore with grid lines. With them a path along the shore has the shore's own length instead
// of that of a staircase.
#pragma once

#include "bake/height_map.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tidemark::bake {

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

} // namespace tidemark::bake
