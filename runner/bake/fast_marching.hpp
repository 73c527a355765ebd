// Lengths of the shortest ways over water: the eikonal equation |grad u| = 1 solved outwards from where u is
// known, in one pass (J. A. Sethian, "A fast marching level set method for monotonically advancing fronts",
// 1996). Knows nothing of waves or pictures.
#pragma once

#include "bake/height_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace tidemark::bake {

/// Differences that the upwind scheme takes where it has two known nodes in a row; else the first order's.
enum class Stencil { first_order = 1, second_order = 2 };

struct Distances {
    std::vector<double> of_node; ///< metres; infinite on land and where no water leads
    size_t updates = 0;          ///< local solutions: the work
    size_t heap_operations = 0;  ///< pushes and pops
};

/// `known` gives u at the nodes where it is given and NaN elsewhere; known nodes on land are not taken.
///
/// Where u is smooth all along a way the differences are of the second order, and so is the error: O(h²).
/// Where ways fan out or meet (a corner that waves bend round, the edge of a shadow, the middle of a closing
/// circle) u has no bounded third derivative: O(h log 1/h) is proved of the first order's scheme there (H.
/// Zhao, "A fast sweeping method for eikonal equations", 2005) and about the first order is measured
/// (march_study.hpp). Beside land each polygon of ShoreCells is solved by the Hopf-Lax formula: u(v) = min
/// over its far edges of (u, linear along the edge, + the way to v), as on triangles (R. Kimmel and J. A.
/// Sethian, "Computing geodesic paths on manifolds", 1998). It is monotone, O(h), and adds nothing to a way
/// along the shore. A polygon may be obtuse at a crossing, so that a value can come after that of its heir:
/// it then corrects the heir, until nothing is left to correct.
Distances fast_march(const HeightMap& map, std::span<const double> known,
                     Stencil stencil = Stencil::second_order);

/// What is known of waves that start on the circle of `radius` metres round the middle and run inwards: the
/// exact distance from it, below 0 outside, at every node that is outside or less than 2.5 spacings inside.
/// So both nodes of a difference of the second order are exact where the march begins.
std::vector<double> known_from_circle(const HeightMap& map, double radius);

} // namespace tidemark::bake
