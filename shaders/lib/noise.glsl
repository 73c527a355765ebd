// Value noise (K. Perlin's lattice noise with values for gradients): random numbers at the points of the
// lattice of whole numbers, interpolated with the fade 3 s^2 - 2 s^3. Range 0..1, once continuously
// differentiable, |gradient| <= 3/2 (reached: the norm is convex in the corners' values, so its largest value
// has corners of 0 and 1 alone; of their 127 patterns the steepest is a face of 0 against a face of 1). Its
// second derivative in any direction is at most 6, of a corner of 1 among 0 (by the same argument, on a grid of 25^3).
// Rounding: 3e-7 plus 1.5 times the rounding of `position`.
#ifndef LIB_NOISE
#define LIB_NOISE
#include "hash.glsl"

// The eight values around `cell`: at x and at x + 1, each in the order (y, z) = 00, 10, 01, 11.
void lattice_cube(vec3 cell, ivec3 beyond, out vec4 left, out vec4 right) {
    Points points = Points(Point(0), k_lattice_weight.y, k_lattice_weight.z,
                           k_lattice_weight.y + k_lattice_weight.z) + lattice_point(cell, beyond);
    left = scatter(points);
    right = scatter(points + k_lattice_weight.x);
}

// `beyond` moves the lattice by whole cells: `position` keeps its last bits however far the noise has drifted.
float value_noise(vec3 position, ivec3 beyond) {
    vec3 cell = floor(position);
    vec3 part = position - cell;
    vec3 s = part * part * (3.0 - 2.0 * part);
    vec4 left, right;
    lattice_cube(cell, beyond, left, right);
    // a + s (b - a) by hand: software rasterisers spend one operation more on mix().
    vec4 edge = left + s.x * (right - left);
    vec2 face = edge.xz + s.y * (edge.yw - edge.xz);
    return k_hash_unit * (face.x + s.z * (face.y - face.x));
}

// In the plane: that of z = 0; `beyond` moves the lattice by whole cells along both axes.
float value_noise(vec2 position, ivec2 beyond) {
    vec2 cell = floor(position);
    vec2 part = position - cell;
    vec2 s = part * part * (3.0 - 2.0 * part);
    Points points = Points(Point(0), k_lattice_weight.x, k_lattice_weight.y,
                           k_lattice_weight.x + k_lattice_weight.y);
    vec4 square = scatter(points + lattice_point(vec3(cell, 0.0), ivec3(beyond, 0)));
    vec2 edge = square.xz + s.x * (square.yw - square.xz);
    return k_hash_unit * (edge.x + s.y * (edge.y - edge.x));
}

// In the plane: the noise and, in yz, its gradient.
vec3 value_noise_gradient(vec2 position, ivec2 beyond) {
    vec2 cell = floor(position);
    vec2 part = position - cell;
    vec2 s = part * part * (3.0 - 2.0 * part);
    vec2 ds = 6.0 * part * (1.0 - part);
    Points corners = Points(Point(0), k_lattice_weight.x, k_lattice_weight.y,
                            k_lattice_weight.x + k_lattice_weight.y);
    vec4 square = scatter(corners + lattice_point(vec3(cell, 0.0), ivec3(beyond, 0)));
    vec2 along_x = square.yw - square.xz;
    vec2 edge = square.xz + s.x * along_x;
    float along_y = edge.y - edge.x;
    return k_hash_unit * vec3(edge.x + s.y * along_y,
                              ds * vec2(along_x.x + s.y * (along_x.y - along_x.x), along_y));
}

// The noise and, in yzw, its gradient.
vec4 value_noise_gradient(vec3 position, ivec3 beyond) {
    vec3 cell = floor(position);
    vec3 part = position - cell;
    vec3 s = part * part * (3.0 - 2.0 * part);
    vec3 ds = 6.0 * part * (1.0 - part);
    vec4 left, right;
    lattice_cube(cell, beyond, left, right);
    vec4 along_x = right - left;
    vec4 edge = left + s.x * along_x;
    vec2 along_y = edge.yw - edge.xz;
    vec2 face = edge.xz + s.y * along_y;
    float along_z = face.y - face.x;
    vec2 slope_x = along_x.xz + s.y * (along_x.yw - along_x.xz);
    return k_hash_unit * vec4(face.x + s.z * along_z,
                              ds * vec3(slope_x.x + s.z * (slope_x.y - slope_x.x),
                                        along_y.x + s.z * (along_y.y - along_y.x), along_z));
}

// The noise and, in y, how it changes along `along`.
vec2 value_noise_along(vec3 position, vec3 along, ivec3 beyond) {
    vec3 cell = floor(position);
    vec3 part = position - cell;
    vec3 square = part * part;
    vec3 s = square * (3.0 - 2.0 * part);
    vec3 ds = 6.0 * along * (part - square);
    vec4 left, right;
    lattice_cube(cell, beyond, left, right);
    vec4 along_x = right - left;
    vec4 edge = left + s.x * along_x;
    vec4 edge_slope = ds.x * along_x;
    vec2 along_y = edge.yw - edge.xz;
    vec2 face = edge.xz + s.y * along_y;
    vec2 face_slope = edge_slope.xz + s.y * (edge_slope.yw - edge_slope.xz) + ds.y * along_y;
    float along_z = face.y - face.x;
    return k_hash_unit * vec2(face.x + s.z * along_z,
                              face_slope.x + s.z * (face_slope.y - face_slope.x) + ds.z * along_z);
}
#endif
