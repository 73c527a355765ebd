// Measures the error of the marching against its run time, on maps whose shortest paths are known exactly.
#pragma once

#include "bake/fast_marching.hpp"

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::bake {

/// Where a path keeps a tenth of the circle's radius away from all land and from the centre, u is smooth on
/// all sides and the error is of the second order; elsewhere (in the shadow of land, near land and near the
/// shadow's edge) of the first. The centre, where the circle closes on itself and only the first order is
/// possible, counts as `rest` in open water; the other cases leave it out.
enum class Region { smooth, rest, left_out };

/// A map with an exact answer, for waves that run inwards from the circle of radius 1.
struct KnownCase {
    std::string_view name;
    std::string_view description;
    double (*height)(Point);
    double (*exact)(Point); ///< for points where `height` is below 0, inside the circle
    Region (*region)(Point);
};

/// Returns the cases: open water; a disc to go round (tangent, arc, tangent); a ring with a gap (a corner
/// that waves bend round).
std::span<const KnownCase> known_cases();

/// Returns the case's map with `side` nodes per side; the circle's radius is 15/16 of half its extent.
HeightMap map_of(const KnownCase& known, int side);

struct ErrorNorms {
    double largest = 0.0;
    double rms = 0.0;
};

/// Distances of every node that counts, in radii.
struct Ways {
    std::vector<double> exact;
    std::vector<double> found;
};

/// One solution, in units of the circle's radius.
struct MarchSample {
    int side = 0;
    double spacing = 0.0;             ///< between nodes
    Ways ways;                        ///< of both regions
    std::array<ErrorNorms, 2> errors; ///< by Region
    double seconds = 0.0;             ///< CPU time of the march, the shore's polygons included
    Distances work;                   ///< `of_node` is empty
};

MarchSample study_march(const KnownCase& known, int side, Stencil stencil);

/// Returns that march as a function that can be timed repeatedly.
std::function<void()> march_of(const KnownCase& known, int side, Stencil stencil);

} // namespace tidemark::bake
