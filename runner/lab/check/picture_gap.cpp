#include "lab/check/picture_gap.hpp"

#include "image/compare/metrics.hpp"
#include "lab/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tidemark::lab {

namespace {

/// Returns the largest sample difference of each pixel.
std::vector<double> largest_differences(const image::Image& left, const image::Image& right) {
    std::vector<double> largest(left.extent.pixels());
    const auto channels = size_t(left.channels);
    for (size_t i = 0; i < left.samples(); ++i) {
        const double difference = std::abs(double(left.f32()[i]) - double(right.f32()[i]));
        // A sample that is finite in one picture only gets the largest difference.
        const bool same =
            left.f32()[i] == right.f32()[i] || (std::isnan(left.f32()[i]) && std::isnan(right.f32()[i]));
        double& most = largest[i / channels];
        most = std::max(most, same ? 0.0 : std::isfinite(difference) ? difference : 1.0);
    }
    return largest;
}

bool is_number(const image::Image& image, size_t pixel) {
    const auto samples = image.f32().subspan(pixel * size_t(image.channels), size_t(image.channels));
    return std::ranges::all_of(samples, [](float sample) { return std::isfinite(sample); });
}

std::string decibels(double mean_square) {
    return mean_square == 0 ? "the same" : fmt::format("{:.1f} dB", -10 * std::log10(mean_square));
}

} // namespace

double p99_difference(const image::Image& left, const image::Image& right) {
    return quantile(largest_differences(left, right), 0.99);
}

double visibly_different_percent(const image::Image& left, const image::Image& right) {
    const std::vector<double> largest = largest_differences(left, right);
    const auto visible = std::ranges::count_if(largest, [](double gap) { return gap > k_visible_gap; });
    return 100 * double(visible) / double(largest.size());
}

std::string alikeness(const image::Image& before, const image::Image& after) {
    if (const auto difference = image::compare(before, after); difference && !std::isnan(difference->psnr))
        return decibels(difference->rmse * difference->rmse);
    const auto channels = size_t(before.channels);
    size_t none_before = 0, none_after = 0, numbers = 0;
    double squares = 0;
    for (size_t pixel = 0; pixel < before.extent.pixels(); ++pixel) {
        const bool first = is_number(before, pixel), second = is_number(after, pixel);
        none_before += !first;
        none_after += !second;
        if (!first || !second)
            continue;
        ++numbers;
        for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i)
            squares += std::pow(double(before.f32()[i]) - double(after.f32()[i]), 2);
    }
    const std::string counted =
        fmt::format("{} pixels with NaN or infinity become {}", none_before, none_after);
    return numbers == 0
               ? counted + ", and no pixel is finite in both"
               : fmt::format("{}, {} over the rest", counted, decibels(squares / double(numbers * channels)));
}

size_t different_pixels(const image::Image& left, const image::Image& right) {
    const auto pixel = std::ptrdiff_t(left.row_bytes()) / left.extent.width;
    size_t count = 0;
    for (auto a = left.bytes.begin(), b = right.bytes.begin(); a != left.bytes.end(); a += pixel, b += pixel)
        count += !std::equal(a, a + pixel, b);
    return count;
}

} // namespace tidemark::lab
