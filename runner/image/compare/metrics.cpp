#include "image/compare/metrics.hpp"

#include "base/try.hpp"
#include "image/compare/flip.hpp"
#include "image/compare/ssim.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace tidemark::image {
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

} // namespace tidemark::image
