#include "bake/fast_marching.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

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

namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// One axis of the upwind scheme: weight (u - base)² is the square of its difference.
struct Upwind {
    double base = k_infinite;
    double weight = 0.0;
};

/// Returns the larger root of sum of both axes = 1, or of the nearer axis alone if the front has not reached
/// the other.
double solve(Upwind a, Upwind b) {
    if (a.base > b.base)
        std::swap(a, b);
    const double along_a = a.base + 1.0 / std::sqrt(a.weight);
    if (!(along_a > b.base))
        return along_a;
    const double gap = b.base - a.base;
    const double sum = a.weight + b.weight;
    const double root = sum - a.weight * b.weight * gap * gap; // above 0: along_a > b.base
    return a.base + (b.weight * gap + std::sqrt(std::max(root, 0.0))) / sum;
}

/// Returns the shortest distance at `to` over the segment from `a` to `b`, with u linear from `u_a` to `u_b`.
/// Either end may be infinite.
double over_segment(Point to, Point a, double u_a, Point b, double u_b) {
    const double from_ends = std::min(u_a + distance(to, a), u_b + distance(to, b));
    const double length = distance(a, b);
    const double slope = (u_b - u_a) / length;
    if (!(std::abs(slope) < 1.0)) // also NaN: an end without a value, or two crossings at one point
        return from_ends;
    const Point along{(b.x - a.x) / length, (b.y - a.y) / length};
    const Point offset{to.x - a.x, to.y - a.y};
    const double foot = offset.x * along.x + offset.y * along.y;
    const double away = std::abs(offset.x * along.y - offset.y * along.x);
    const double at = foot - slope * away / std::sqrt(1.0 - slope * slope);
    if (at <= 0.0 || at >= length)
        return from_ends;
    const double rest = foot - at;
    return std::min(from_ends, u_a + slope * at + std::sqrt(away * away + rest * rest));
}

class March {
public:
    March(const HeightMap& map, Stencil stencil)
        : map_(map), shore_(map), second_order_(stencil == Stencil::second_order),
          inverse_square_(1.0 / (map.spacing() * map.spacing())), u_(size_t(shore_.vertices()), k_infinite),
          accepted_(size_t(shore_.vertices()), false) {}

    Distances run(std::span<const double> known) {
        std::vector<int> sources;
        for (int node = 0; node < int(map_.heights.size()); ++node)
            if (map_.is_water(node) && !std::isnan(known[size_t(node)])) {
                value(node) = known[size_t(node)];
                accepted_[size_t(node)] = true;
                sources.push_back(node);
            }
        for (const int node : sources)
            spread(node);
        while (!heap_.empty()) {
            const auto [reached, vertex] = heap_.top();
            heap_.pop();
            ++result_.heap_operations;
            if (reached > value(vertex)) // improved since it was pushed
                continue;
            accepted_[size_t(vertex)] = true;
            spread(vertex);
        }
        u_.resize(map_.heights.size());
        result_.of_node = std::move(u_);
        return std::move(result_);
    }

private:
    double& value(int vertex) { return u_[size_t(vertex)]; }
    bool is_node(int vertex) const { return vertex < int(map_.heights.size()); }
    Point place(int vertex) const {
        return is_node(vertex) ? map_.position(vertex)
                               : shore_.crossings()[size_t(vertex) - map_.heights.size()];
    }

    /// Returns the node `steps` from `node` in direction (dx, dy), or -1 beyond the edge.
    int beside(int node, int dx, int dy, int steps) const {
        const int x = node % map_.side + dx * steps, y = node / map_.side + dy * steps;
        return x < 0 || y < 0 || x >= map_.side || y >= map_.side ? -1 : map_.node(x, y);
    }

    double accepted_value(int node) const {
        return node >= 0 && accepted_[size_t(node)] ? u_[size_t(node)] : k_infinite;
    }

    /// Returns the difference towards the side from which the front comes. There is always water between
    /// adjacent water nodes.
    Upwind upwind(int node, int dx, int dy) const {
        const double ahead = accepted_value(beside(node, dx, dy, 1));
        const double behind = accepted_value(beside(node, -dx, -dy, 1));
        const int side = ahead < behind ? 1 : -1;
        const double near = std::min(ahead, behind);
        if (!second_order_ || near == k_infinite)
            return {near, inverse_square_};
        const double far = accepted_value(beside(node, side * dx, side * dy, 2));
        if (far > near)
            return {near, inverse_square_};
        return {(4.0 * near - far) / 3.0, 2.25 * inverse_square_};
    }

    double over_polygons(int vertex) const {
        double least = k_infinite;
        const Point to = place(vertex);
        for (const int index : shore_.polygons_at(vertex)) {
            const WaterPolygon& polygon = shore_.polygon(index);
            for (int i = 0; i < polygon.size; ++i) {
                const int a = polygon.corners[size_t(i)], b = polygon.corners[size_t((i + 1) % polygon.size)];
                if (a == vertex || b == vertex)
                    continue;
                const double u_a = accepted_value(a), u_b = accepted_value(b);
                if (u_a < k_infinite || u_b < k_infinite)
                    least = std::min(least, over_segment(to, place(a), u_a, place(b), u_b));
            }
        }
        return least;
    }

    void update(int vertex) {
        const bool again = accepted_[size_t(vertex)];
        if (again && shore_.polygons_at(vertex).empty())
            return;
        ++result_.updates;
        double reached = over_polygons(vertex);
        if (is_node(vertex) && !again) {
            const Upwind x = upwind(vertex, 1, 0), y = upwind(vertex, 0, 1);
            if (x.base < k_infinite || y.base < k_infinite)
                reached = std::min(reached, solve(x, y));
        }
        // A correction below this limit is rounding; without the limit the march might not end.
        if (!(reached < value(vertex) - (again ? k_correction * map_.spacing() : 0.0)))
            return;
        value(vertex) = reached;
        accepted_[size_t(vertex)] = false;
        heap_.emplace(reached, vertex);
        ++result_.heap_operations;
    }

    void spread(int vertex) {
        if (is_node(vertex))
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                if (const int node = beside(vertex, dx, dy, 1); node >= 0 && map_.is_water(node))
                    update(node);
        for (const int index : shore_.polygons_at(vertex)) {
            const WaterPolygon& polygon = shore_.polygon(index);
            for (int i = 0; i < polygon.size; ++i)
                if (polygon.corners[size_t(i)] != vertex)
                    update(polygon.corners[size_t(i)]);
        }
    }

    static constexpr double k_correction = 1e-9; ///< in spacings

    using Entry = std::pair<double, int>;
    const HeightMap& map_;
    ShoreCells shore_;
    bool second_order_;
    double inverse_square_;
    std::vector<double> u_; ///< of every vertex: nodes, then crossings
    std::vector<bool> accepted_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
    Distances result_;
};

} // namespace

Distances fast_march(const HeightMap& map, std::span<const double> known, Stencil stencil) {
    assert(known.size() == map.heights.size());
    return March(map, stencil).run(known);
}

std::vector<double> known_from_circle(const HeightMap& map, double radius) {
    std::vector<double> known(map.heights.size(), std::numeric_limits<double>::quiet_NaN());
    for (int node = 0; node < int(known.size()); ++node)
        if (const double straight = radius - length(map.position(node)); straight < 2.5 * map.spacing())
            known[size_t(node)] = straight;
    return known;
}

} // namespace tidemark::bake
