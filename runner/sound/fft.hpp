// The discrete Fourier transform. Forty lines of our own: only one size is needed, at most 128 times a frame
// for each sound, and the resulting bytes must not depend on a library's choice of algorithm.
#pragma once

#include <complex>
#include <span>

namespace tidemark::sound {

/// Replaces x by X[k] = sum of x[n] exp(-2 pi i n k / N), not scaled. N is a power of two.
void transform(std::span<std::complex<double>> x);

} // namespace tidemark::sound
