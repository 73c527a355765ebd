// Cellular noise (S. Worley, "A cellular texture basis function", 1996): how far it is to the nearest of points of
// which each cell of a square lattice has one. The points circle in their cells.
#ifndef LIB_CELLS
#define LIB_CELLS
#include "hash.glsl"

// Two numbers, 0..1, of a lattice point in the plane.
vec2 cell_hash(vec2 cell) {
    Point point = lattice_point(vec3(cell, 0.0), ivec3(0));
    return k_hash_unit * scatter(Points(point, point + k_lattice_weight.z, point, point)).xy;
}

// The way to the nearest point (xy) and its length (z, 0..1.16); `turns` 0..1: how far the points have come
// round. The length is continuous, its slope at most 1, with kinks half-way between points. Only the 9 cells
// around `at` are looked at: points stay 0.18 from the edges of their cells, so that the one in the cell of `at`
// is at most 0.82 sqrt(2) away and those of cells further off at least 1.18.
vec3 nearest_cell(vec2 at, float turns) {
    vec2 cell = floor(at);
    vec3 nearest = vec3(0.0, 0.0, 4.0);
    for (int i = 0; i < 9; ++i) {
        vec2 beside = cell + vec2(i % 3 - 1, i / 3 - 1);
        vec2 angle = 6.283185307 * (cell_hash(beside) + vec2(turns, -turns));
        vec2 way = beside + 0.5 + 0.32 * sin(angle) - at;
        float square = dot(way, way);
        if (square < nearest.z) {
            nearest = vec3(way, square);
        }
    }
    return vec3(nearest.xy, sqrt(nearest.z));
}
#endif
