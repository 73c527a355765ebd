#include "bake/fast_marching_study.hpp"

#include <algorithm>
#include <ctime>

namespace tidemark::bake {
namespace {

constexpr double k_clear = 0.1;

double angle_of(Point p) {
    return std::atan2(p.y, p.x);
}

double straight(Point p) {
    return 1.0 - length(p);
}

// ---- Open water -----------------------------------------------------------------------------------------

double open_height(Point) {
    return -1.0;
}

Region open_region(Point p) {
    return length(p) > k_clear ? Region::smooth : Region::rest;
}

// ---- A disc, off the grid's lines and diagonals ---------------------------------------------------------

constexpr Point k_disc{0.41, 0.23};
constexpr double k_disc_radius = 0.27;

double disc_height(Point p) {
    return k_disc_radius - distance(p, k_disc);
}

/// Returns how near the straight path outwards from `p` comes to the disc's centre.
double passes_disc(Point p) {
    const double r = std::max(length(p), 1e-300);
    const double ahead = (p.x * k_disc.x + p.y * k_disc.y) / r - r;
    const double across = std::abs(p.x * k_disc.y - p.y * k_disc.x) / r;
    return ahead > 0.0 ? across : distance(p, k_disc);
}

/// The path starts at a right angle to the circle, touches the disc along a line through the centre of the
/// map, follows an arc, and leaves on the tangent to `p`, on the side where it is shorter.
double disc_exact(Point p) {
    if (passes_disc(p) >= k_disc_radius)
        return straight(p);
    const double middle = length(k_disc);
    const double away = std::max(distance(p, k_disc), k_disc_radius); // a crossing may lie inside by O(h²)
    const double to_middle = angle_of({-k_disc.x, -k_disc.y});
    const double turned = angle_of({p.x - k_disc.x, p.y - k_disc.y}) - to_middle;
    const double off_axis = std::abs(std::atan2(std::sin(turned), std::cos(turned)));
    const double touched = std::acos(k_disc_radius / middle), left = std::acos(k_disc_radius / away);
    const double arc = std::max(touched - off_axis - left, 0.0); // towards the nearer side: the shorter
    return 1.0 - std::sqrt(middle * middle - k_disc_radius * k_disc_radius) + k_disc_radius * arc +
           std::sqrt(away * away - k_disc_radius * k_disc_radius);
}

Region disc_region(Point p) {
    if (length(p) < k_clear)
        return Region::left_out;
    return passes_disc(p) > k_disc_radius + k_clear ? Region::smooth : Region::rest;
}

// ---- A ring with a gap, its faces along radii -----------------------------------------------------------

constexpr double k_inner = 0.45, k_outer = 0.65;
constexpr double k_gap_middle = 0.3, k_gap_half = 0.6; // radians

/// Returns radians beyond the gap's nearer face; below 0 in the gap.
double beyond_gap(Point p) {
    const double turned = angle_of(p) - k_gap_middle;
    return std::abs(std::atan2(std::sin(turned), std::cos(turned))) - k_gap_half;
}

double ring_height(Point p) {
    const double r = length(p);
    return std::min({r - k_inner, k_outer - r, r * std::sin(std::min(beyond_gap(p), 1.5))});
}

/// Returns the straight distance if a radius through the gap leads to `p`, otherwise that around the nearer
/// inner corner.
double ring_exact(Point p) {
    if (length(p) >= k_inner || beyond_gap(p) <= 0.0)
        return straight(p);
    const auto round_corner = [&](double angle) {
        return distance(p, {k_inner * std::cos(angle), k_inner * std::sin(angle)}) + 1.0 - k_inner;
    };
    return std::min(round_corner(k_gap_middle - k_gap_half), round_corner(k_gap_middle + k_gap_half));
}

Region ring_region(Point p) {
    const double r = length(p);
    if (r < k_clear)
        return Region::left_out;
    if (r > k_outer + k_clear)
        return Region::smooth;
    const double nearest = std::max(r, k_inner) * std::sin(std::clamp(-beyond_gap(p), 0.0, 1.5));
    return nearest > k_clear ? Region::smooth : Region::rest;
}

constexpr std::array<KnownCase, 3> k_cases{{
    {"open", "open water", open_height, straight, open_region},
    {"disc", "a disc to go round", disc_height, disc_exact, disc_region},
    {"gap", "a ring with a gap", ring_height, ring_exact, ring_region},
}};

class NormSum {
public:
    void add(double error) {
        norms_.largest = std::max(norms_.largest, error);
        square_ += error * error;
        ++count_;
    }
    ErrorNorms norms() const {
        return {norms_.largest, count_ == 0 ? 0.0 : std::sqrt(square_ / double(count_))};
    }

private:
    ErrorNorms norms_;
    double square_ = 0.0;
    size_t count_ = 0;
};

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace

std::span<const KnownCase> known_cases() {
    return k_cases;
}

HeightMap map_of(const KnownCase& known, int side) {
    HeightMap map(side, 2.0 * 16.0 / 15.0);
    for (int node = 0; node < side * side; ++node)
        map.heights[size_t(node)] = known.height(map.position(node));
    return map;
}

MarchSample study_march(const KnownCase& known, int side, Stencil stencil) {
    const HeightMap map = map_of(known, side);
    const std::vector<double> source = known_from_circle(map, 1.0);
    MarchSample sample;
    sample.side = side;
    sample.spacing = map.spacing();
    const double start = cpu_seconds();
    sample.work = fast_march(map, source, stencil);
    sample.seconds = cpu_seconds() - start;

    std::array<NormSum, 3> sums; // by Region
    for (int node = 0; node < side * side; ++node)
        if (const Point p = map.position(node); map.is_water(node) && length(p) < 1.0) {
            const Region region = known.region(p);
            const double exact = known.exact(p), found = sample.work.of_node[size_t(node)];
            sums[size_t(region)].add(std::abs(found - exact));
            if (region == Region::left_out)
                continue;
            sample.ways.exact.push_back(exact);
            sample.ways.found.push_back(found);
        }
    sample.errors = {sums[0].norms(), sums[1].norms()};
    sample.work.of_node.clear();
    return sample;
}

std::function<void()> march_of(const KnownCase& known, int side, Stencil stencil) {
    HeightMap map = map_of(known, side);
    std::vector<double> source = known_from_circle(map, 1.0);
    return [map = std::move(map), source = std::move(source), stencil] { fast_march(map, source, stencil); };
}

} // namespace tidemark::bake
