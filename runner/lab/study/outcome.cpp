#include "lab/study/outcome.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

image::PictureMetrics unknown_metrics() {
    image::PictureMetrics metrics;
    metrics.samples.rmse = metrics.samples.psnr = metrics.samples.relative_mse = metrics.samples.largest =
        metrics.ssim = metrics.flip = metrics.largest_flip = std::nan("");
    return metrics;
}

/// Combines the metrics of several pictures of one size; views without any true pixel do not count.
image::PictureMetrics joined(const std::vector<Outcome>& views) {
    size_t pixels = 0;
    for (const Outcome& view : views)
        pixels += view.picture.samples.pixels;
    if (pixels == 0)
        return unknown_metrics();
    image::PictureMetrics all;
    all.ssim = 0;
    double squares = 0;
    for (const Outcome& view : views) {
        const image::PictureDifference& one = view.picture.samples;
        if (one.pixels == 0)
            continue;
        const double part = double(one.pixels) / double(pixels);
        squares += one.rmse * one.rmse * part;
        all.samples.relative_mse += one.relative_mse * part;
        all.samples.largest = std::max(all.samples.largest, one.largest);
        all.samples.pixels += one.pixels;
        all.samples.differing += one.differing;
        all.samples.one_non_finite += one.one_non_finite;
        all.samples.both_non_finite += one.both_non_finite;
        all.ssim += view.picture.ssim * part;
        all.flip += view.picture.flip * part;
        all.largest_flip = std::max(all.largest_flip, view.picture.largest_flip);
    }
    all.samples.rmse = std::sqrt(squares);
    all.samples.psnr = -20.0 * std::log10(all.samples.rmse);
    return all;
}

/// Sets the `blind` pixels to black; returns how many of them were NaN or infinite.
size_t cover(image::Image& picture, const PixelMask& blind) {
    const auto channels = size_t(picture.channels);
    size_t bad = 0;
    for (size_t i = 0; i < blind.size(); ++i) {
        if (!blind[i])
            continue;
        const auto pixel = picture.f32().subspan(i * channels, channels);
        bad += std::ranges::any_of(pixel, [](float sample) { return !std::isfinite(sample); });
        std::ranges::fill(pixel, 0.0F);
    }
    return bad;
}

/// Measures over the pixels that have a truth. For metrics of neighbourhoods the others are black in both
/// pictures.
image::PictureMetrics measured(image::Image truth, image::Image found, const PixelMask& blind) {
    const auto blinded = size_t(std::ranges::count(blind, true));
    (void)cover(truth, blind);
    const size_t bad = cover(found, blind);
    const auto metrics = image::measure(truth, found);
    if (!metrics || blinded == truth.extent.pixels())
        return unknown_metrics();
    image::PictureMetrics seen = *metrics;
    const double share = double(truth.extent.pixels()) / double(truth.extent.pixels() - blinded);
    seen.samples.pixels -= blinded;
    seen.samples.rmse *= std::sqrt(share);
    seen.samples.relative_mse *= share;
    seen.samples.psnr = -20.0 * std::log10(seen.samples.rmse);
    seen.samples.both_non_finite += bad;
    return seen;
}

} // namespace

Outcome outcome_of(const Sight& sight, const Truth& truth, size_t view) {
    Outcome outcome;
    outcome.picture = unknown_metrics();
    if (!truth.pictures.empty()) {
        static const PixelMask k_none;
        const PixelMask& blind = view < truth.blind.size() ? truth.blind[view] : k_none;
        outcome.no_truth = size_t(std::ranges::count(blind, true));
        outcome.picture = measured(truth.pictures[view], sight.pictures[view], blind);
    }
    if (sight.hits.empty() || truth.hits.empty())
        return outcome;
    outcome.hits = hit_errors(truth.hits[view], sight.hits[view], truth.footprints[view]);
    outcome.causes = count(causes(truth.hits[view], sight.hits[view]));
    return outcome;
}

Outcome outcome_of_all(const Sight& sight, const Truth& truth, const std::vector<Outcome>& views) {
    Outcome all;
    all.picture = joined(views);
    for (const Outcome& view : views)
        all.no_truth += view.no_truth;
    if (!views.front().hits)
        return all;
    all.hits = hit_errors(joined(truth.hits), joined(sight.hits), joined(truth.footprints));
    for (const Outcome& view : views)
        for (size_t i = 0; i < k_causes; ++i)
            all.causes[i] += view.causes[i];
    return all;
}

Share share_of(const std::string& source, const Sight& from, const Sight& to, const Truth& truth) {
    Share share{source, 0, pooled_rmse(from.pictures, to.pictures, truth.blind)};
    if (!from.hits.empty() && !to.hits.empty() && !truth.footprints.empty())
        share.rms = hit_errors(joined(to.hits), joined(from.hits), joined(truth.footprints)).rms;
    return share;
}

} // namespace tidemark::lab
