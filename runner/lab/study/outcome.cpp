#include "lab/study/outcome.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// Unit normal of the field's level at `p`: central differences, in double good to about 1e-8.
glm::dvec3 normal_at(const Field& field, const glm::dvec3& p) {
    constexpr double k_step = 1e-5;
    glm::dvec3 slope{0};
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 e{0};
        e[axis] = k_step;
        slope[axis] = field.value(p + e) - field.value(p - e);
    }
    return glm::normalize(slope);
}

/// Every so many pixels: a prime, so that all columns have their turn.
constexpr size_t k_normals_every = 37;

std::optional<double> normal_angle(const Reference& reference, const Hits& truth, const Hits& found,
                                   const image::Image& picture) {
    const auto width = size_t(picture.extent.width);
    std::vector<double> degrees;
    for (size_t i = 0; i < found.size(); i += k_normals_every) {
        if (!(truth.distance[i] >= 0) || !(found.distance[i] >= 0))
            continue;
        const Ray ray = reference.ray({double(i % width) + 0.5, double(i / width) + 0.5});
        const glm::dvec3 a = normal_at(reference.field, ray.at(truth.distance[i]));
        const glm::dvec3 b = normal_at(reference.field, ray.at(found.distance[i]));
        // Well conditioned at small angles, which the arc cosine is not.
        degrees.push_back(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232);
    }
    return degrees.empty() ? std::nullopt : std::optional(median(std::move(degrees)));
}

Hits joined(const std::vector<Hits>& views) {
    Hits all;
    for (const Hits& hits : views)
        all.append(hits);
    return all;
}

std::vector<double> joined(const std::vector<std::vector<double>>& views) {
    std::vector<double> all;
    for (const auto& values : views)
        all.insert(all.end(), values.begin(), values.end());
    return all;
}

/// Metrics of several pictures of one size as of one.
image::PictureMetrics joined(const std::vector<Outcome>& views) {
    image::PictureMetrics all;
    all.ssim = 0;
    const double part = 1.0 / double(views.size());
    double squares = 0;
    for (const Outcome& view : views) {
        const image::PictureDifference& one = view.picture.samples;
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

} // namespace

Outcome outcome_of(const Sight& sight, const Truth& truth, size_t view) {
    Outcome outcome;
    if (auto metrics = image::measure(truth.pictures[view], sight.pictures[view]))
        outcome.picture = *metrics;
    if (sight.hits.empty() || truth.hits.empty())
        return outcome;
    outcome.hits = hit_errors(truth.hits[view], sight.hits[view], truth.footprints[view]);
    outcome.causes = count(causes(truth.hits[view], sight.hits[view]));
    if (!truth.references.empty())
        outcome.normal_degrees =
            normal_angle(truth.references[view], truth.hits[view], sight.hits[view], sight.pictures[view]);
    return outcome;
}

Outcome outcome_of_all(const Sight& sight, const Truth& truth, const std::vector<Outcome>& views) {
    Outcome all;
    all.picture = joined(views);
    if (!views.front().hits)
        return all;
    all.hits = hit_errors(joined(truth.hits), joined(sight.hits), joined(truth.footprints));
    for (const Outcome& view : views) {
        for (size_t i = 0; i < k_causes; ++i)
            all.causes[i] += view.causes[i];
        if (view.normal_degrees) // the worst view's
            all.normal_degrees = std::max(all.normal_degrees.value_or(0), *view.normal_degrees);
    }
    return all;
}

Share share_of(const std::string& source, const Sight& from, const Sight& to, const Truth& truth) {
    Share share{source, 0, pooled_rmse(from.pictures, to.pictures)};
    if (!from.hits.empty() && !to.hits.empty() && !truth.footprints.empty())
        share.rms = hit_errors(joined(to.hits), joined(from.hits), joined(truth.footprints)).rms;
    return share;
}

} // namespace tidemark::lab
