#include "image/compare/ssim.hpp"

#include "image/plane.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

namespace tidemark::image {
namespace {

Plane product(const Plane& a, const Plane& b) {
    Plane result(a.extent);
    for (size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = a.values[i] * b.values[i];
    return result;
}

Kernel window() {
    Kernel kernel = gaussian(1.5, k_ssim_window / 2);
    const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
    for (double& weight : kernel)
        weight /= sum;
    return kernel;
}

double ssim(const Plane& a, const Plane& b) {
    constexpr double k_c1 = 0.01 * 0.01, k_c2 = 0.03 * 0.03;
    constexpr int k_margin = k_ssim_window / 2;
    const Kernel kernel = window();
    const auto smooth = [&](const Plane& plane) { return convolved(plane, kernel, kernel); };
    const Plane mean_a = smooth(a), mean_b = smooth(b);
    const Plane square_a = smooth(product(a, a)), square_b = smooth(product(b, b)),
                mixed = smooth(product(a, b));
    double sum = 0.0;
    size_t places = 0;
    for (int y = k_margin; y < a.extent.height - k_margin; ++y)
        for (int x = k_margin; x < a.extent.width - k_margin; ++x, ++places) {
            const double ma = mean_a.at(x, y), mb = mean_b.at(x, y);
            const double variance_a = square_a.at(x, y) - ma * ma, variance_b = square_b.at(x, y) - mb * mb;
            const double covariance = mixed.at(x, y) - ma * mb;
            sum += (2 * ma * mb + k_c1) * (2 * covariance + k_c2) /
                   ((ma * ma + mb * mb + k_c1) * (variance_a + variance_b + k_c2));
        }
    return sum / double(places);
}

} // namespace

double ssim(const Image& left, const Image& right) {
    assert(left.extent == right.extent);
    if (left.extent.width < k_ssim_window || left.extent.height < k_ssim_window)
        return std::nan("");
    const auto a = shown_colours(left), b = shown_colours(right);
    return (ssim(a[0], b[0]) + ssim(a[1], b[1]) + ssim(a[2], b[2])) / 3.0;
}

} // namespace tidemark::image
