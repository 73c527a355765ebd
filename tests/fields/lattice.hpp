// The random numbers that value noise stands on: one for each point of a lattice of whole numbers. Integer
// lattices are the same on every device and are computed here bit for bit; lattices of sines are whatever
// the device's sine makes of them, and are read back from it.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

namespace tidemark::fields {

/// `integer_hash` of shaders/lib/hash.glsl, 0 <= value < 1, of points taken modulo 2^32.
struct IntegerLattice {
    double operator()(int64_t x, int64_t y, int64_t z) const;
    double operator()(int64_t x, int64_t y) const { return (*this)(x, y, 0); }
};

/// `sine_hash` of shaders/lib/hash.glsl at 7 x + 157 y + 113 z: values[i] is the device's own value for
/// first + i. A point that was not read back has the value NaN, so that no march can pass it off as known.
struct SineLattice {
    int64_t first = 0;
    std::vector<float> values;

    double operator()(int64_t x, int64_t y, int64_t z) const;
};

using Lattice3 = std::variant<IntegerLattice, SineLattice>;

} // namespace tidemark::fields
