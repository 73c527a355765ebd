// The discrete Fourier transform. Forty lines of our own: one size is needed, a few dozen times a frame at
// most, and the bytes that come of it must not change with a library's choice of algorithm.
#pragma once

#include <complex>
#include <span>

namespace tidemark::sound {

/// Replaces x by X[k] = sum of x[n] exp(-2 pi i n k / N), not scaled. N is a power of two.
void transform(std::span<std::complex<double>> x);

} // namespace tidemark::sound
