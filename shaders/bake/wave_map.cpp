#include "bake/wave_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::bake {
namespace {

/// Returns 0 up to `from` and 1 beyond `to`, with a smooth transition. Uses sums and products only: the same
/// bits on every machine.
double rise(double from, double to, double x) {
    const double part = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return part * part * (3.0 - 2.0 * part);
}

constexpr double k_land_reach = 27.0;
constexpr double k_rock_reach = 20.0;
constexpr int k_rocks = 18;

/// Returns 0..1 for a lattice point: odd multiplications, with the high bits folded down between them.
double lattice(int64_t x, int64_t y, uint32_t seed) {
    uint32_t bits = uint32_t(x) * 0x9e3779b1u ^ uint32_t(y) * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
    bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
    return double(bits ^ (bits >> 15)) / 4294967296.0;
}

/// Returns -1..1; a lattice cell has the size 1.
double value_noise(Point p, uint32_t seed) {
    const double cell_x = std::floor(p.x), cell_y = std::floor(p.y);
    const double part_x = rise(0.0, 1.0, p.x - cell_x), part_y = rise(0.0, 1.0, p.y - cell_y);
    const auto x = int64_t(cell_x), y = int64_t(cell_y);
    const auto row = [&](int64_t at) {
        const double left = lattice(x, at, seed);
        return left + part_x * (lattice(x + 1, at, seed) - left);
    };
    const double low = row(y);
    return 2.0 * (low + part_y * (row(y + 1) - low)) - 1.0;
}

/// Returns about -1..1; the coarsest bumps are `size` metres apart, each octave half as large and 0.45 as
/// high.
double fractal(Point p, double size, int octaves, uint32_t seed) {
    double sum = 0.0, weight = 0.55;
    Point at{p.x / size, p.y / size};
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * value_noise(at, seed + uint32_t(octave));
        weight *= 0.45;
        at = {1.6 * at.x - 1.2 * at.y + 17.3, 1.2 * at.x + 1.6 * at.y - 5.9}; // twice as fine, rotated
    }
    return sum;
}

/// Returns the larger, with a fillet of about `radius` where both are near.
double smooth_max(double a, double b, double radius) {
    const double near = std::max(radius - std::abs(a - b), 0.0) / radius;
    return std::max(a, b) + 0.25 * radius * near * near;
}

struct Disc {
    Point middle;
    double radius;
};

/// Returns metres inwards from an outline made of a few discs and noise; below 0 at sea.
double inland(Point p, uint32_t seed) {
    static constexpr std::array<Disc, 5> k_discs{{{{2.0, 1.0}, 8.2},
                                                  {{-8.8, 5.6}, 4.6},
                                                  {{9.0, -6.6}, 4.0},
                                                  {{8.2, 9.2}, 3.2},
                                                  {{-13.6, -10.0}, 2.6}}};
    const Point bent{p.x + 2.4 * fractal(p, 7.0, 3, seed + 11), p.y + 2.4 * fractal(p, 6.0, 3, seed + 23)};
    double inward = -1e3;
    for (const Disc& disc : k_discs)
        inward = smooth_max(inward, disc.radius - distance(bent, disc.middle), 2.5);
    return inward;
}

/// Returns a beach on both sides of the waterline, hills inland of it, and a floor that falls off to sea.
double ground(Point p, uint32_t seed) {
    const double inward = inland(p, seed);
    const double beach = 0.2 * inward * (inward < 0.0 ? rise(8.0, 0.0, -inward) * 0.9 + 0.1 : 1.0);
    const double hills = 3.0 * rise(0.9, 8.0, inward) * (1.0 + 0.55 * fractal(p, 5.0, 4, seed + 37));
    const double cliffs = 0.9 * rise(0.25, 0.75, fractal(p, 7.0, 2, seed + 41)) * rise(0.9, 1.7, inward);
    const double floor = -5.2 * rise(0.5, 15.0, -inward) * (1.0 + 0.5 * fractal(p, 7.0, 3, seed + 53));
    return beach + hills + cliffs + floor;
}

struct Rock {
    Point middle;
    double radius; ///< at the waterline
    double top;
};

std::vector<Rock> scatter_rocks(uint32_t seed) {
    std::mt19937 random(seed);
    const auto between = [&](double from, double to) {
        return from + (to - from) * (double(random()) / 4294967296.0); // the engine's output is standard
    };
    std::vector<Rock> rocks;
    while (rocks.size() < k_rocks) {
        const Point at{between(-k_rock_reach, k_rock_reach), between(-k_rock_reach, k_rock_reach)};
        const double size = between(0.0, 1.0), top = between(1.1, 1.8);
        const double from_land = -inland(at, seed);
        if (length(at) > k_rock_reach || from_land < 1.2 || from_land > 6.0)
            continue;
        const double radius = 0.4 + 1.2 * size * size * size;
        const bool apart = std::none_of(rocks.begin(), rocks.end(), [&](const Rock& rock) {
            return distance(rock.middle, at) < 1.3 * (rock.radius + radius);
        });
        if (apart)
            rocks.push_back({at, radius, top * (0.4 + 0.8 * radius)});
    }
    return rocks;
}

double with_rocks(double floor, Point p, const std::vector<Rock>& rocks, uint32_t seed) {
    for (const Rock& rock : rocks) {
        const double away = distance(p, rock.middle) / rock.radius;
        if (away > 3.0)
            continue;
        const double rough = away * (1.0 + 0.4 * fractal(p, 1.1, 3, seed + 67));
        floor = smooth_max(floor, rock.top * (1.0 - rough * rough), 0.25);
    }
    return floor;
}

} // namespace

HeightMap make_island(int side, uint32_t seed) {
    HeightMap map(side, k_island_extent);
    const std::vector<Rock> rocks = scatter_rocks(seed);
    for (int node = 0; node < side * side; ++node) {
        const Point p = map.position(node);
        const double height = with_rocks(ground(p, seed), p, rocks, seed);
        // The open sea begins at k_land_reach for every seed.
        map.heights[size_t(node)] = height - (height + 5.0) * rise(k_rock_reach, k_land_reach, length(p));
    }
    return map;
}

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
