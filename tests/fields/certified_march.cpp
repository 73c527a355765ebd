#include "fields/certified_march.hpp"

#include <algorithm>
#include <cmath>

namespace tidemark::fields {
namespace {

/// Returns the place where the field changes its sign between `outside` (>= 0) and `inside` (< 0), to the
/// last bits.
double bisect(const Field& field, const Ray& ray, double outside, double inside, int& samples) {
    while (true) {
        const double middle = outside + 0.5 * (inside - outside);
        if (middle <= outside || middle >= inside)
            return inside;
        ++samples;
        (field.value(ray.at(middle)) < 0 ? inside : outside) = middle;
    }
}

/// The slab is taken wider by this, so that its own rounding leaves no zero outside.
constexpr double k_slab_margin = 1e-9;

} // namespace

RayRange clip_to_slab(const Field& field, const Ray& ray, RayRange range) {
    const double y = ray.origin.y, dy = ray.direction.y;
    const double highest = field.highest + k_slab_margin, lowest = field.lowest - k_slab_margin;
    const auto cross = [&](double level) { return (level - y) / dy; };
    if (dy < 0) {
        range.near = std::max(range.near, cross(highest));
        range.far = std::min(range.far, std::max(range.near, cross(lowest)));
    } else if (dy > 0) {
        range.far = std::min(range.far, cross(highest));
    } else if (y > highest) {
        range.far = -1;
    }
    return range;
}

CertifiedHit certified_march(const Field& field, const Ray& ray, RayRange range,
                             const CertifiedOptions& options) {
    range = clip_to_slab(field, ray, range);
    CertifiedHit hit{-1, 0, false};
    double outside = range.near;
    for (double t = range.near; t <= range.far;) {
        const FieldSample sample = field.sample(ray.at(t), ray.direction);
        ++hit.samples;
        if (std::isnan(sample.value) || std::isnan(sample.clearance)) {
            hit.distance = NAN;
            return hit;
        }
        if (sample.value < 0) {
            hit.started_inside = hit.samples == 1;
            hit.distance = hit.started_inside ? t : bisect(field, ray, outside, t, hit.samples);
            return hit;
        }
        if (t == range.far)
            return hit;
        outside = t;
        t = std::min(t + std::max(sample.clearance, options.shortest_step), range.far);
    }
    return hit;
}

} // namespace tidemark::fields
