// Lengths of the shortest ways over water: the eikonal equation |grad u| = 1 solved outwards from where u is
// known, in one pass (J. A. Sethian, "A fast marching level set method for monotonically advancing fronts",
// 1996). Knows nothing of waves or pictures.
#pragma once

#include "terrain/height_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace tidemark::terrain {

/// Differences that the upwind scheme takes where it has two known nodes in a row; else the first order's.
enum class Stencil { first_order = 1, second_order = 2 };

struct Distances {
    std::vector<double> of_node; ///< metres; infinite on land and where no water leads
    size_t updates = 0;          ///< local solutions: the work
    size_t heap_operations = 0;  ///< pushes and pops
};

/// `known` gives u at the nodes where it is given and NaN elsewhere; known nodes on land are not taken.
///
/// Open water, second order: the error is O(h²) where u is smooth and O(h) at most where ways meet or fan out
/// (a corner that waves bend round, the shadow's edge, the middle of a closing circle), where u has no
/// bounded third derivative. Beside land each cell of ShoreCells is solved by the Hopf-Lax formula on its
/// polygon: u(v) = min over its far edges of (u linear along the edge + the way to v), which is monotone and
/// O(h) and adds nothing to a way along the shore (R. Kimmel and J. A. Sethian, "Computing geodesic paths on
/// manifolds", 1998). A polygon may be obtuse at a crossing, so that a value can come after that of its heir:
/// it then corrects the heir, until nothing is left to correct.
Distances fast_march(const HeightMap& map, std::span<const double> known,
                     Stencil stencil = Stencil::second_order);

/// What is known of waves that start on the circle of `radius` metres round the middle and run inwards: the
/// exact distance from it, below 0 outside, at every node that is outside or less than 2.5 spacings inside.
/// So both nodes of a difference of the second order are exact where the march begins.
std::vector<double> known_from_circle(const HeightMap& map, double radius);

} // namespace tidemark::terrain
