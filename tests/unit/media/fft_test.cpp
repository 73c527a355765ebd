#include "media/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace tidemark::sound::fft_test {

using Complex = std::complex<double>;

std::vector<Complex> naive(const std::vector<Complex>& x) {
    std::vector<Complex> result(x.size());
    for (size_t k = 0; k < x.size(); ++k)
        for (size_t n = 0; n < x.size(); ++n)
            result[k] +=
                x[n] * std::polar(1.0, -2.0 * std::numbers::pi * double(n * k % x.size()) / double(x.size()));
    return result;
}

TEST(Fft, is_the_discrete_fourier_transform) {
    std::mt19937 random(1);
    for (size_t size = 1; size <= 2048; size *= 2) {
        std::vector<Complex> x(size);
        for (Complex& value : x)
            value = {double(random()) / 4294967296.0 - 0.5, double(random()) / 4294967296.0 - 0.5};
        const std::vector<Complex> wanted = naive(x);
        transform(x);
        for (size_t k = 0; k < size; ++k)
            ASSERT_LT(std::abs(x[k] - wanted[k]), 1e-11) << size << ' ' << k;
    }
}

TEST(Fft, impulse_has_a_flat_spectrum_and_an_exponential_one_line) {
    std::vector<Complex> x(64);
    x[0] = 1.0;
    transform(x);
    for (const Complex& value : x)
        EXPECT_EQ(value, Complex(1.0));
    for (size_t n = 0; n < 64; ++n)
        x[n] = std::polar(1.0, 2.0 * std::numbers::pi * 5.0 * double(n) / 64.0);
    transform(x);
    for (size_t k = 0; k < 64; ++k)
        EXPECT_NEAR(std::abs(x[k]), k == 5 ? 64.0 : 0.0, 1e-12);
}

} // namespace tidemark::sound::fft_test
