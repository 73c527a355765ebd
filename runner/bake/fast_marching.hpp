// Computes the lengths of shortest paths over water: solves the eikonal equation |grad u| = 1 outwards from
// nodes with known u, in one pass (J. A. Sethian, "A fast marching level set method for monotonically
// advancing fronts", 1996). Independent of waves and pictures.
#pragma once

#include "bake/height_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace tidemark::bake {

/// Order of the differences. The second order needs two known nodes in a row; otherwise the first is used.
enum class Stencil { first_order = 1, second_order = 2 };

struct Distances {
    std::vector<double> of_node; ///< metres; infinite on land and where water does not lead
    size_t updates = 0;          ///< local solutions, a measure of the work
    size_t heap_operations = 0;  ///< pushes and pops
};

/// Marches from `known`, which holds u where it is known and NaN elsewhere; known nodes on land are ignored.
///
/// Where u is smooth along a whole path, the differences are of the second order, and so is the error: O(h²).
/// Where paths fan out or meet (a corner that waves bend round, the edge of a shadow, the centre of a closing
/// circle), u has no bounded third derivative: O(h log 1/h) is proved for the first-order scheme there (H.
/// Zhao, "A fast sweeping method for eikonal equations", 2005), and about the first order is measured
/// (march_study.hpp). At the shore each polygon of ShoreCells is solved by the Hopf-Lax formula: u(v) = min
/// over its far edges of (u, linear along the edge, + the distance to v), as on triangles (R. Kimmel and J.
/// A. Sethian, "Computing geodesic paths on manifolds", 1998). It is monotone, O(h), and adds nothing to a
/// path along the shore. A polygon may be obtuse at a crossing, so that a vertex can be accepted after one
/// whose value depends on it: it then corrects that one, until no correction is left.
Distances fast_march(const HeightMap& map, std::span<const double> known,
                     Stencil stencil = Stencil::second_order);

/// Returns the known values of waves that start on the circle of `radius` metres around the centre and run
/// inwards: the exact distance from it, below 0 outside, at every node that is outside or less than 2.5
/// spacings inside. Both nodes of a second-order difference are therefore exact where the march begins.
std::vector<double> known_from_circle(const HeightMap& map, double radius);

} // namespace tidemark::bake
