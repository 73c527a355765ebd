// Error of the marching against its run time, on maps whose shortest ways are known exactly.
#pragma once

#include "bake/fast_marching.hpp"

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::bake {

/// Where a way keeps a tenth of the circle's radius from all land and from the middle, u is smooth all round
/// and the error of the second order; elsewhere (behind land, beside land and the edge of its shadow) of the
/// first.
/// The middle, where the circle closes on itself and the first order is all there is, is the rest of open
/// water; the other cases leave it out.
enum class Region { smooth, rest, left_out };

/// Waves from the circle of radius 1 inwards over a map with an exact answer.
struct KnownCase {
    std::string_view name;
    std::string_view description;
    double (*height)(Point);
    double (*exact)(Point); ///< where `height` is below 0, inside the circle
    Region (*region)(Point);
};

/// Open water; a disc to go round (tangent, arc, tangent); a ring with a gap (a corner that waves bend
/// round).
std::span<const KnownCase> known_cases();

/// The case's map with `side` nodes a side, 15/16 of its half the circle's radius.
HeightMap map_of(const KnownCase& known, int side);

struct ErrorNorms {
    double largest = 0.0;
    double rms = 0.0;
};

/// Of every node that counts, in radii.
struct Ways {
    std::vector<double> exact;
    std::vector<double> found;
};

/// One solution, in units of the circle's radius.
struct MarchSample {
    int side = 0;
    double spacing = 0.0;             ///< of the nodes
    Ways ways;                        ///< of both regions
    std::array<ErrorNorms, 2> errors; ///< by Region
    double seconds = 0.0;             ///< CPU time of the march, the shore's polygons included
    Distances work;                   ///< `of_node` empty
};

MarchSample study_march(const KnownCase& known, int side, Stencil stencil);

/// That march ready to be run again and again, for a clock.
std::function<void()> march_of(const KnownCase& known, int side, Stencil stencil);

} // namespace tidemark::bake
