// Random numbers for the points of a lattice, without state. INTEGER_HASH (1 unless the scene says 0) chooses
// between the two kinds below for everything in the library.
#ifndef LIB_HASH
#define LIB_HASH
#ifndef INTEGER_HASH
#define INTEGER_HASH 1
#endif

#if INTEGER_HASH
// A lattice point is one number modulo 2^32: the sum of its coordinates with odd weights, which are powers of
// the root of x^4 = x + 1, inverted, times 2^32 (M. Roberts' R-sequence), so that neighbours fall far apart.
#define Point uint
#define Points uvec4
const uvec3 k_lattice_weight = uvec3(3518319155u, 2882110345u, 2360945575u);
const float k_hash_unit = 1.0 / 16777216.0;

// The number of each point in units of k_hash_unit: whole, 0..2^24 - 1, the same bits on every device.
// Folding the high half onto the low one and one odd multiplication leave the upper 24 bits without
// correlation at any offset up to 6 (3.4 sigma at most over 1,098 offsets, of the values and of their distance
// from the mean).
vec4 scatter(Points points) {
    return vec4(ivec4(((points ^ (points >> 15)) * 0xb995450du) >> 8));
}

// `cell` has whole coordinates below 2^31; `beyond` is added to it, exactly at any size.
Point lattice_point(vec3 cell, ivec3 beyond) {
    uvec3 at = uvec3(ivec3(cell) + beyond) * k_lattice_weight;
    return at.x + at.y + at.z;
}
#else
// fract(sin(n) * 43785.5), as it is common: it multiplies the rounding of the device's sine by 43785, so each
// maker's GPU has a lattice of its own, and far from 0 also each driver (numbers of one driver differ from
// those of glibc's sine in 0.03 % of the points up to n = 150,000, of others in 98 %).
#define Point float
#define Points vec4
const vec3 k_lattice_weight = vec3(7.0, 157.0, 113.0);
const float k_hash_unit = 1.0;

// 0..1
vec4 scatter(Points points) {
    return fract(sin(points) * 43785.5);
}

// Exact as long as the sum is below 2^24.
Point lattice_point(vec3 cell, ivec3 beyond) {
    return dot(cell + vec3(beyond), k_lattice_weight);
}
#endif
#endif
