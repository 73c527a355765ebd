#include "sound/fft.hpp"

#include <bit>
#include <cassert>
#include <numbers>
#include <utility>
#include <vector>

namespace tidemark::sound {
namespace {

using Complex = std::complex<double>;

/// Multiplies without the operator's handling of infinities, which costs more than the multiplication.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

void reverse_bits_of_indices(std::span<Complex> x) {
    size_t reversed = 0;
    for (size_t i = 1; i < x.size(); ++i) {
        size_t bit = x.size() >> 1;
        for (; (reversed & bit) != 0; bit >>= 1)
            reversed ^= bit;
        reversed ^= bit;
        if (i < reversed)
            std::swap(x[i], x[reversed]);
    }
}

} // namespace

void transform(std::span<Complex> x) {
    const size_t size = x.size();
    assert(std::has_single_bit(size));
    std::vector<Complex> turns(size / 2);
    for (size_t i = 0; i < turns.size(); ++i)
        turns[i] = std::polar(1.0, -2.0 * std::numbers::pi * double(i) / double(size));
    reverse_bits_of_indices(x);
    for (size_t half = 1; half < size; half *= 2) {
        const size_t stride = size / (2 * half);
        for (size_t first = 0; first < size; first += 2 * half) {
            for (size_t i = 0; i < half; ++i) {
                Complex& low = x[first + i];
                Complex& high = x[first + i + half];
                const Complex turned = product(high, turns[i * stride]);
                high = low - turned;
                low += turned;
            }
        }
    }
}

} // namespace tidemark::sound
