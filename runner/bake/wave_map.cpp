#include "bake/wave_map.hpp"

#include "bake/fast_marching.hpp"
#include "bake/smooth_step.hpp"
#include "base/try.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace tidemark::bake {
namespace {

tl::unexpected<Error> refuse(std::string why) {
    return fail(ErrorCode::load, std::move(why));
}

/// Returns column and row, counted from 0 at the top left as image editors do.
std::string place_of(const HeightMap& map, int node) {
    return fmt::format("column {}, row {}", node % map.side, map.side - 1 - node / map.side);
}

Result<void> check_water(const HeightMap& map) {
    const double least = *std::min_element(map.heights.begin(), map.heights.end());
    if (least >= 0.0)
        return refuse(fmt::format(
            "there is no water: the lowest height is {:.3g} m above the sea; raise --sea", least));
    const double radius = circle_radius(map);
    for (int node = 0; node < map.side * map.side; ++node) {
        // The nodes that the march takes as known, and one spacing more.
        const double inside = radius - length(map.position(node));
        if (std::abs(inside) <= 3.5 * map.spacing() && !map.is_water(node))
            return refuse(
                fmt::format("the circle where the waves start, {:g} m round the middle, meets land at "
                            "{}: leave open water there, or raise --sea",
                            radius, place_of(map, node)));
    }
    return {};
}

/// Gives every node without a value (an infinite one) that of the nearest shore plus the path from there. In
/// the order of that path's length, a value is the mean of the neighbours that it came from (D. Adalsteinsson
/// and J. A. Sethian, "The fast construction of extension velocities in level set methods", 1999). A march of
/// the waves over land would come from the weather side and meet those of the lee shore in a step.
void extend_inland(const HeightMap& map, std::vector<double>& path) {
    HeightMap passable(map.side, map.extent);
    std::fill(passable.heights.begin(), passable.heights.end(), -1.0);
    std::vector<double> at_shore(path.size());
    std::vector<int> inland;
    for (size_t node = 0; node < path.size(); ++node)
        if (std::isinf(path[node])) {
            at_shore[node] = std::numeric_limits<double>::quiet_NaN();
            inland.push_back(int(node));
        }
    // The value is 0 on all water, so that second-order differences would be wrong there.
    const std::vector<double> away = fast_march(passable, at_shore, Stencil::first_order).of_node;
    std::sort(inland.begin(), inland.end(), [&](int a, int b) { return away[size_t(a)] < away[size_t(b)]; });

    std::vector<double> shore_path = path;
    for (const int node : inland) {
        double sum = 0.0, weight = 0.0;
        for (const int beside :
             {node - 1, node + 1, node - map.side, node + map.side}) { // none is at the edge
            const double nearer = away[size_t(node)] - away[size_t(beside)];
            if (nearer > 0.0) {
                sum += nearer * shore_path[size_t(beside)];
                weight += nearer;
            }
        }
        shore_path[size_t(node)] = sum / weight;
        path[size_t(node)] = shore_path[size_t(node)] + away[size_t(node)];
    }
}

/// Returns finite values everywhere: outside the circle straight, inside over water, elsewhere from the
/// nearest shore.
std::vector<double> path_distances(const HeightMap& map) {
    const std::vector<double> known = known_from_circle(map, circle_radius(map));
    std::vector<double> path = fast_march(map, known).of_node;
    for (size_t node = 0; node < path.size(); ++node) // land outside the circle
        if (std::isinf(path[node]) && !std::isnan(known[node]))
            path[node] = known[node];
    extend_inland(map, path);
    return path;
}

} // namespace

Result<image::Image> bake_wave_map(const HeightMap& map) {
    TRY(check_water(map));
    const std::vector<double> path = path_distances(map);
    image::Image image({map.side, map.side}, 4, image::SampleType::f32);
    for (size_t node = 0; node < path.size(); ++node) {
        const double straight = circle_radius(map) - length(map.position(int(node)));
        const double mask = 1.0 - rise(k_detour_from, k_detour_to, path[node] - straight);
        const double height = map.heights[node];
        const auto texel = image.f32().subspan(4 * node, 4);
        texel[0] = float(path[node]);
        texel[1] = float(mask);
        texel[2] = float(std::max(-height, 0.0));
        texel[3] = float(height);
    }
    return image;
}

Result<HeightMap> heights_from(const image::Image& picture, double extent, double sea, double metres) {
    const Extent size = picture.extent;
    if (size.width != size.height)
        return refuse(fmt::format("a height map is square; this picture is {}x{}", size.width, size.height));
    if (size.width < k_least_side || size.width > k_largest_side)
        return refuse(fmt::format("a height map has {} to {} pixels a side; this one has {}", k_least_side,
                                  k_largest_side, size.width));
    HeightMap map(size.width, extent);
    for (size_t node = 0; node < map.heights.size(); ++node) {
        const size_t sample = node * size_t(picture.channels);
        const double value = picture.type == image::SampleType::u8 ? picture.u8()[sample] / 255.0
                                                                   : double(picture.f32()[sample]);
        map.heights[node] = metres * (value - sea);
        if (!std::isfinite(value))
            return refuse(fmt::format("the height at {} is {}", place_of(map, int(node)),
                                      std::isnan(value) ? "not a number" : "infinite"));
        if (std::abs(map.heights[node]) > k_largest_metres)
            return refuse(fmt::format("the height at {} is {:.3g} m, beyond {:g}; see --metres",
                                      place_of(map, int(node)), map.heights[node], k_largest_metres));
    }
    return map;
}

} // namespace tidemark::bake
