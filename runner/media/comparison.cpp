#include "media/comparison.hpp"

#include "base/error.hpp"
#include "media/file_samples.hpp"
#include "media/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace tidemark::image {
namespace {

/// Convolves a row or a column: `step` is 1 along rows and the width along columns.
void convolve_line(const double* from, double* to, int length, size_t step, const Kernel& kernel) {
    const int radius = int(kernel.size() / 2);
    for (int i = 0; i < length; ++i) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k)
            sum += kernel[size_t(k + radius)] * from[size_t(std::clamp(i + k, 0, length - 1)) * step];
        to[size_t(i) * step] = sum;
    }
}

} // namespace

Kernel gaussian(double deviation, int radius) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x)
        kernel.push_back(std::exp(-double(x * x) / (2.0 * deviation * deviation)));
    return kernel;
}

Plane convolved(const Plane& plane, const Kernel& row, const Kernel& column) {
    assert(row.size() % 2 == 1 && column.size() % 2 == 1);
    const auto width = size_t(plane.extent.width);
    Plane across(plane.extent), result(plane.extent);
    for (int y = 0; y < plane.extent.height; ++y)
        convolve_line(&plane.values[size_t(y) * width], &across.values[size_t(y) * width], plane.extent.width,
                      1, row);
    for (size_t x = 0; x < width; ++x)
        convolve_line(&across.values[x], &result.values[x], plane.extent.height, width, column);
    return result;
}

Plane channel_of(const Image& image, int channel) {
    Plane plane(image.extent);
    const auto channels = size_t(image.channels);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const size_t sample = i * channels + size_t(channel);
        plane.values[i] = image.type == SampleType::u8 ? image.u8()[sample] / 255.0 : image.f32()[sample];
    }
    return plane;
}

std::array<Plane, 3> shown_colours(const Image& image) {
    std::array<Plane, 3> colours;
    for (int i = 0; i < 3; ++i) {
        colours[size_t(i)] = channel_of(image, image.channels < 3 ? 0 : i);
        for (double& value : colours[size_t(i)].values)
            value = value > 0.0 ? std::min(value, 1.0) : 0.0; // NaN gives 0
    }
    return colours;
}

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

namespace {

using Colour = std::array<float, 3>;

constexpr Colour k_magenta{1.0f, 0.0f, 1.0f};
constexpr Colour k_heat[] = {{0.0f, 0.0f, 0.02f},
                             {0.13f, 0.07f, 0.45f},
                             {0.72f, 0.13f, 0.33f},
                             {0.99f, 0.58f, 0.16f},
                             {1.0f, 1.0f, 0.75f}};

/// Returns the absolute difference, 0 for equal values, and NaN for any other pair with a NaN or infinity.
double distance(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b)))
        return 0.0;
    return std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) : std::nan("");
}

} // namespace

Colour heat(double value) {
    constexpr int k_last = int(std::size(k_heat)) - 1;
    const double place = std::clamp(value, 0.0, 1.0) * k_last;
    const int below = std::min(int(place), k_last - 1);
    const auto part = float(place - below);
    Colour colour{};
    for (size_t c = 0; c < 3; ++c)
        colour[c] = k_heat[below][c] + part * (k_heat[below + 1][c] - k_heat[below][c]);
    return colour;
}

Image heat_map(const Plane& plane) {
    Image image(plane.extent, 3, SampleType::f32);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const double value = plane.values[i];
        std::ranges::copy(std::isnan(value) ? k_magenta : heat(value),
                          image.f32().begin() + ptrdiff_t(3 * i));
    }
    return image;
}

Image difference_picture(const Image& left, const Image& right, double gain) {
    assert(left.extent == right.extent && left.channels == right.channels);
    std::array<Plane, 3> planes;
    for (int c = 0; c < 3; ++c) {
        const int channel = left.channels < 3 ? 0 : c;
        const Plane a = channel_of(left, channel), b = channel_of(right, channel);
        planes[size_t(c)] = Plane(left.extent);
        for (size_t i = 0; i < a.values.size(); ++i)
            planes[size_t(c)].values[i] = gain * distance(a.values[i], b.values[i]);
    }
    Image image(left.extent, 3, SampleType::f32);
    for (size_t i = 0; i < image.extent.pixels(); ++i) {
        Colour colour{float(planes[0].values[i]), float(planes[1].values[i]), float(planes[2].values[i])};
        if (std::ranges::any_of(colour, [](float v) { return std::isnan(v); }))
            colour = k_magenta;
        std::ranges::copy(colour, image.f32().begin() + ptrdiff_t(3 * i));
    }
    return image;
}

namespace {

/// Returns the absolute difference, or NaN if it is undefined. Bytes are compared as integers, so that a step
/// of one is 1/255 to the last bit.
double distance(uint8_t left, uint8_t right) {
    return double(std::abs(int(left) - int(right))) / 255.0;
}

double distance(float left, float right) {
    if (left == right || (std::isnan(left) && std::isnan(right))) // also equal infinities
        return 0.0;
    if (!std::isfinite(left) || !std::isfinite(right))
        return std::nan("");
    return std::abs(double(left) - double(right));
}

/// Converts a byte as a float file stores it.
float as_float(uint8_t value) {
    return float(value) / 255.0f;
}
double distance(uint8_t left, float right) {
    return distance(as_float(left), right);
}
double distance(float left, uint8_t right) {
    return distance(left, as_float(right));
}

double magnitude(uint8_t value) {
    return value / 255.0;
}
double magnitude(float value) {
    return std::abs(double(value));
}

bool non_finite(uint8_t) {
    return false;
}
bool non_finite(float value) {
    return !std::isfinite(value);
}

template <class Left, class Right>
PictureDifference difference(std::span<const Left> left, std::span<const Right> right, size_t channels,
                             double tolerance) {
    PictureDifference result;
    result.pixels = left.size() / channels;
    double squares = 0.0, relative = 0.0;
    for (size_t pixel = 0; pixel < result.pixels; ++pixel) {
        bool differs = false, bad_left = false, bad_right = false;
        for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
            const double d = distance(left[i], right[i]);
            differs |= !(d <= tolerance); // true for NaN
            bad_left |= non_finite(left[i]);
            bad_right |= non_finite(right[i]);
            squares += d * d;
            if (d != 0.0) { // skips equal infinities
                const double part = d / (magnitude(left[i]) + 0.01);
                relative += part * part;
            }
            if (d > result.largest) // false for NaN
                result.largest = d;
        }
        result.differing += differs;
        result.one_non_finite += bad_left != bad_right;
        result.both_non_finite += bad_left && bad_right;
    }
    result.rmse = left.empty() ? 0.0 : std::sqrt(squares / double(left.size()));
    result.relative_mse = left.empty() ? 0.0 : relative / double(left.size());
    result.psnr = -20.0 * std::log10(result.rmse);
    return result;
}

std::string shape_of(const Image& image) {
    return fmt::format("{}x{} with {} channel{}", image.extent.width, image.extent.height, image.channels,
                       image.channels == 1 ? "" : "s");
}

} // namespace

Result<PictureDifference> compare(const Image& left, const Image& right, double tolerance) {
    if (left.extent != right.extent || left.channels != right.channels)
        return fail(ErrorCode::check_failed,
                    fmt::format("the pictures cannot be compared: one is {}, the other {}", shape_of(left),
                                shape_of(right)));
    assert(left.channels > 0);
    const auto channels = size_t(left.channels);
    const bool left_u8 = left.type == SampleType::u8, right_u8 = right.type == SampleType::u8;
    if (left_u8 && right_u8)
        return difference(left.u8(), right.u8(), channels, tolerance);
    if (left_u8)
        return difference(left.u8(), right.f32(), channels, tolerance);
    if (right_u8)
        return difference(left.f32(), right.u8(), channels, tolerance);
    return difference(left.f32(), right.f32(), channels, tolerance);
}

Result<PictureMetrics> measure(const Image& reference, const Image& test, double tolerance) {
    auto samples = TRY(compare(reference, test, tolerance));
    PictureMetrics metrics{samples};
    if (std::isnan(samples.rmse)) {
        metrics.ssim = metrics.flip = metrics.largest_flip = std::nan("");
        return metrics;
    }
    metrics.ssim = ssim(reference, test);
    const Flip seen = flip(reference, test);
    metrics.flip = seen.mean;
    metrics.largest_flip = seen.largest;
    return metrics;
}

namespace {

bool is_grey(const Image& image) {
    return image.channels < 3;
}

} // namespace

SameChannels same_channels(Image left, Image right) {
    SameChannels same{std::move(left), std::move(right), {}};
    const auto note = [&](const std::string& text) { same.note += (same.note.empty() ? "" : "; ") + text; };
    if (is_grey(same.left) != is_grey(same.right))
        note(fmt::format("{} is grey: its value counts as red, green and blue",
                         is_grey(same.left) ? "A" : "B"));
    bool alpha = same.left.has_alpha();
    if (alpha != same.right.has_alpha()) {
        Image& having = alpha ? same.left : same.right;
        const char *has = alpha ? "A" : "B", *has_not = alpha ? "B" : "A";
        alpha = !has_opaque_alpha(having);
        if (!alpha)
            having = without_alpha(having);
        note(alpha ? fmt::format("{} has no alpha: it counts as 1", has_not)
                   : fmt::format("only {} has an alpha, 1 throughout: it is not compared", has));
    }
    const bool coloured = !is_grey(same.left) || !is_grey(same.right);
    const int channels = (coloured ? 3 : 1) + (alpha ? 1 : 0);
    same.left = with_channels(same.left, channels);
    same.right = with_channels(same.right, channels);
    return same;
}

} // namespace tidemark::image
