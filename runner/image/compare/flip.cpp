#include "image/compare/flip.hpp"

#include "image/transfer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace tidemark::image {
namespace {

constexpr double k_pi = 3.14159265358979323846;

using Triple = std::array<double, 3>;
using Planes = std::array<Plane, 3>;

// ---- Colour spaces --------------------------------------------------------------------------------------

/// Linear sRGB to XYZ, D65: rows X, Y, Z, as IEC 61966-2-1's primaries and white give them exactly.
constexpr double k_to_xyz[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
};

/// Converts linear sRGB to X, Y, Z relative to the white point.
Triple relative_xyz(const Triple& rgb) {
    Triple xyz{};
    for (size_t row = 0; row < 3; ++row) {
        const double* m = k_to_xyz[row];
        xyz[row] = (m[0] * rgb[0] + m[1] * rgb[1] + m[2] * rgb[2]) / (m[0] + m[1] + m[2]);
    }
    return xyz;
}

/// Inverts relative_xyz, by Cramer's rule on the matrix above.
Triple linear_rgb(const Triple& xyz) {
    double m[3][3];
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column)
            m[row][column] = k_to_xyz[row][column] / (k_to_xyz[row][0] + k_to_xyz[row][1] + k_to_xyz[row][2]);
    const auto minor = [&m](size_t r, size_t c) {
        const size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    Triple rgb{};
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = (minor(0, c) * xyz[0] + minor(1, c) * xyz[1] + minor(2, c) * xyz[2]) / determinant;
    return rgb;
}

/// Converts to Y, Cx, Cz: CIELAB without its cube roots, in which contrast sensitivity was measured.
Triple opponent(const Triple& xyz) {
    return {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])};
}

Triple xyz_of_opponent(const Triple& yxz) {
    const double y = (yxz[0] + 16.0) / 116.0;
    return {y + yxz[1] / 500.0, y, y - yxz[2] / 200.0};
}

/// Converts to CIELAB and scales a and b by L / 100 after Hunt: colours seem stronger in the light.
Triple hunt_lab(const Triple& rgb) {
    constexpr double k_delta = 6.0 / 29.0;
    Triple f = relative_xyz(rgb);
    for (double& t : f)
        t = t > k_delta * k_delta * k_delta ? std::cbrt(t) : t / (3.0 * k_delta * k_delta) + 4.0 / 29.0;
    const double lightness = 116.0 * f[1] - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])};
}

double hyab(const Triple& a, const Triple& b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

Triple at(const Planes& planes, size_t pixel) {
    return {planes[0].values[pixel], planes[1].values[pixel], planes[2].values[pixel]};
}

Planes opponent_of(const Image& image) {
    Planes planes = shown_colours(image);
    for (size_t i = 0; i < planes[0].values.size(); ++i) {
        const Triple rgb = at(planes, i);
        const Triple yxz =
            opponent(relative_xyz({light_of_srgb(rgb[0]), light_of_srgb(rgb[1]), light_of_srgb(rgb[2])}));
        for (size_t c = 0; c < 3; ++c)
            planes[c].values[i] = yxz[c];
    }
    return planes;
}

// ---- Colour ---------------------------------------------------------------------------------------------

/// A Gaussian of the transformed contrast sensitivity function: a sqrt(pi/b) exp(-pi² x² / b), x in degrees.
struct Bell {
    double a;
    double b;
};
struct Sensitivity {
    Bell first, second;
};
constexpr Sensitivity k_sensitivity[3] = {
    {{1.0, 0.0047}, {0.0, 1.0e-5}}, {{1.0, 0.0053}, {0.0, 1.0e-5}}, {{34.1, 0.04}, {13.5, 0.025}}};
constexpr double k_widest = 0.04;

double sum_of(const Kernel& kernel) {
    return std::accumulate(kernel.begin(), kernel.end(), 0.0);
}

/// Blurs a plane by the eye's contrast sensitivity at that many pixels a degree.
Plane seen(const Plane& plane, const Sensitivity& eye, double pixels_per_degree) {
    const int radius = int(std::ceil(3.0 * std::sqrt(k_widest / (2.0 * k_pi * k_pi)) * pixels_per_degree));
    Plane result(plane.extent);
    double total = 0.0;
    for (const Bell& bell : {eye.first, eye.second}) {
        if (bell.a == 0.0)
            continue;
        const Kernel kernel = gaussian(std::sqrt(bell.b / 2.0) / k_pi * pixels_per_degree, radius);
        const double height = bell.a * std::sqrt(k_pi / bell.b);
        total += height * sum_of(kernel) * sum_of(kernel);
        const Plane blurred = convolved(plane, kernel, kernel);
        for (size_t i = 0; i < result.values.size(); ++i)
            result.values[i] += height * blurred.values[i];
    }
    for (double& value : result.values)
        value /= total;
    return result;
}

constexpr double k_colour_exponent = 0.7;

/// Maps a colour distance to 0..1: linearly up to 0.4 of the largest, which becomes 0.95, and linearly from
/// there to 1.
double redistributed(double distance, double largest) {
    constexpr double k_knee = 0.4, k_knee_value = 0.95;
    const double knee = k_knee * largest;
    return distance < knee ? k_knee_value / knee * distance
                           : k_knee_value + (distance - knee) / (largest - knee) * (1.0 - k_knee_value);
}

Triple shown_lab(const Planes& planes, size_t pixel) {
    Triple rgb = linear_rgb(xyz_of_opponent(at(planes, pixel)));
    for (double& value : rgb)
        value = std::clamp(value, 0.0, 1.0);
    return hunt_lab(rgb);
}

Plane colour_difference(const Planes& reference, const Planes& test, double pixels_per_degree) {
    Planes left, right;
    for (size_t c = 0; c < 3; ++c) {
        left[c] = seen(reference[c], k_sensitivity[c], pixels_per_degree);
        right[c] = seen(test[c], k_sensitivity[c], pixels_per_degree);
    }
    // The largest distance of two colours is that of green and blue.
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), k_colour_exponent);
    Plane result(reference[0].extent);
    for (size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = redistributed(
            std::pow(hyab(shown_lab(left, i), shown_lab(right, i)), k_colour_exponent), largest);
    return result;
}

// ---- Edges and points -----------------------------------------------------------------------------------

/// Scales the positive and the negative weights to sum to 1 and -1 over the product with `across`.
Kernel balanced(Kernel kernel, const Kernel& across) {
    double positive = 0.0, negative = 0.0;
    for (const double weight : kernel)
        (weight > 0.0 ? positive : negative) += std::abs(weight) * sum_of(across);
    for (double& weight : kernel)
        weight /= weight > 0.0 ? positive : negative;
    return kernel;
}

/// Returns the strength of a feature in each pixel: the length of the filter responses along x and y.
Plane strength(const Plane& luminance, const Kernel& along, const Kernel& across) {
    const Plane x = convolved(luminance, along, across), y = convolved(luminance, across, along);
    Plane result(luminance.extent);
    for (size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::hypot(x.values[i], y.values[i]);
    return result;
}

Plane feature_difference(Plane reference, Plane test, double pixels_per_degree) {
    constexpr double k_width = 0.082; // degrees between the peaks of a detector
    const double deviation = 0.5 * k_width * pixels_per_degree;
    const int radius = int(std::ceil(3.0 * deviation));
    const Kernel bell = gaussian(deviation, radius);
    Kernel slope = bell, curvature = bell;
    for (int x = -radius; x <= radius; ++x) {
        slope[size_t(x + radius)] *= -double(x);
        curvature[size_t(x + radius)] *= double(x * x) / (deviation * deviation) - 1.0;
    }
    slope = balanced(slope, bell);
    curvature = balanced(curvature, bell);
    for (Plane* plane : {&reference, &test})
        for (double& value : plane->values)
            value = (value + 16.0) / 116.0;
    const Plane edges[2] = {strength(reference, slope, bell), strength(test, slope, bell)};
    const Plane points[2] = {strength(reference, curvature, bell), strength(test, curvature, bell)};
    Plane result(reference.extent);
    for (size_t i = 0; i < result.values.size(); ++i) {
        const double edge = std::abs(edges[0].values[i] - edges[1].values[i]);
        const double point = std::abs(points[0].values[i] - points[1].values[i]);
        result.values[i] = std::sqrt(std::max(edge, point) / std::sqrt(2.0));
    }
    return result;
}

} // namespace

Flip flip(const Image& reference, const Image& test, double pixels_per_degree) {
    assert(reference.extent == test.extent);
    const Planes left = opponent_of(reference), right = opponent_of(test);
    Flip result{colour_difference(left, right, pixels_per_degree)};
    const Plane features = feature_difference(left[0], right[0], pixels_per_degree);
    for (size_t i = 0; i < features.values.size(); ++i) {
        double& value = result.map.values[i];
        value = std::pow(value, 1.0 - features.values[i]);
        result.mean += value;
        result.largest = std::max(result.largest, value);
    }
    result.mean /= double(std::max<size_t>(1, features.values.size()));
    return result;
}

} // namespace tidemark::image
