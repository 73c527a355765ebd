#include "bake/shore_cells.hpp"

#include <algorithm>
#include <numeric>

namespace tidemark::bake {
namespace {

/// Computes the one crossing of each grid line between water and land.
class Crossings {
public:
    Crossings(const HeightMap& map, std::vector<Point>& points)
        : map_(&map), points_(&points), east_(map.heights.size(), -1), north_(map.heights.size(), -1) {}

    int between(int a, int b) {
        const int low = std::min(a, b), high = std::max(a, b);
        int& crossing = (high == low + 1 ? east_ : north_)[size_t(low)];
        if (crossing < 0) {
            crossing = int(map_->heights.size() + points_->size());
            points_->push_back(place(low, high));
        }
        return crossing;
    }

private:
    Point place(int a, int b) const {
        const double height_a = map_->heights[size_t(a)], height_b = map_->heights[size_t(b)];
        const double part = height_a / (height_a - height_b); // signs differ: 0..1
        const Point from = map_->position(a), to = map_->position(b);
        return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
    }

    const HeightMap* map_;
    std::vector<Point>* points_;
    std::vector<int> east_, north_; ///< crossing on the line from a node to its neighbour in that direction,
                                    ///< or -1
};

} // namespace

ShoreCells::ShoreCells(const HeightMap& map) : nodes_(map.heights.size()) {
    Crossings crossings(map, crossings_);
    for (int y = 0; y + 1 < map.side; ++y)
        for (int x = 0; x + 1 < map.side; ++x) {
            const std::array cell{map.node(x, y), map.node(x + 1, y), map.node(x + 1, y + 1),
                                  map.node(x, y + 1)};
            const auto wet = [&](int i) { return map.is_water(cell[size_t(i & 3)]); };
            if (wet(0) == wet(1) && wet(1) == wet(2) && wet(2) == wet(3))
                continue;
            // Each run of wet corners between two dry ones is a polygon.
            for (int first = 0; first < 4; ++first) {
                if (!wet(first) || wet(first + 3))
                    continue;
                WaterPolygon polygon;
                const auto add = [&](int vertex) { polygon.corners[size_t(polygon.size++)] = vertex; };
                add(crossings.between(cell[size_t((first + 3) & 3)], cell[size_t(first)]));
                int corner = first;
                for (; wet(corner); ++corner)
                    add(cell[size_t(corner & 3)]);
                add(crossings.between(cell[size_t((corner - 1) & 3)], cell[size_t(corner & 3)]));
                polygons_.push_back(polygon);
            }
        }
    index_polygons();
}

void ShoreCells::index_polygons() {
    const auto for_each_corner = [&](const auto& visit) {
        for (size_t i = 0; i < polygons_.size(); ++i)
            for (int corner = 0; corner < polygons_[i].size; ++corner)
                visit(size_t(polygons_[i].corners[size_t(corner)]), int(i));
    };
    first_.assign(size_t(vertices()) + 1, 0);
    for_each_corner([&](size_t vertex, int) { ++first_[vertex + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    incidence_.resize(size_t(first_.back()));
    std::vector<int> next = first_;
    for_each_corner([&](size_t vertex, int polygon) { incidence_[size_t(next[vertex]++)] = polygon; });
}

} // namespace tidemark::bake
