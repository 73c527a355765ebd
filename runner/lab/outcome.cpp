#include "lab/outcome.hpp"

#include "lab/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

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

namespace {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * 8) == 0);
}

/// Compares pictures and the places where rays end; the amount of work does not count.
bool shows_same(const Sight& a, const Sight& b) {
    return a.pictures == b.pictures && a.hits.size() == b.hits.size() &&
           std::equal(a.hits.begin(), a.hits.end(), b.hits.begin(),
                      [](const Hits& x, const Hits& y) { return same_bits(x.distance, y.distance); });
}

/// Returns whether two points have the same values for all knobs except `but`.
bool same_but(const WorkPrecisionSet& set, const Point& a, const Point& b,
              const std::vector<std::string>& names, const std::vector<std::string>& but) {
    return std::ranges::all_of(names, [&](const std::string& name) {
        return std::ranges::find(but, name) != but.end() || value_at(set, a, name) == value_at(set, b, name);
    });
}

/// For the points of `series` and the unchanged scene: returns whether points that differ only in `knob`
/// exist and all show the same.
bool is_idle(const WorkPrecisionSet& set, const std::vector<Sight>& sights,
             const std::vector<std::string>& names, size_t series, const std::string& knob) {
    bool compared = false;
    for (size_t i = 1; i < set.points.size(); ++i) {
        const WorkPrecision& point = set.points[i];
        if (point.point.series != series || !point.measured())
            continue;
        for (size_t k = 0; k < i; ++k) {
            const WorkPrecision& other = set.points[k];
            if (!other.measured() || !same_but(set, point.point, other.point, names, {knob}) ||
                value_at(set, point.point, knob) == value_at(set, other.point, knob))
                continue;
            if (!shows_same(sights[i], sights[k]))
                return false;
            compared = true;
        }
    }
    return compared;
}

/// The points of one curve that can be used for its order, from coarse to strict.
struct Curve {
    std::vector<Setting> fixed;
    std::vector<double> knob, error; ///< logarithms
    std::vector<std::string> values;
    size_t points = 0; ///< including hollow and other unused points
};

double slope_between(const Curve& curve, size_t i) {
    return (curve.error[i + 1] - curve.error[i]) / (curve.knob[i + 1] - curve.knob[i]);
}

/// Least squares: returns the slope and its standard error.
std::pair<double, double> fit(const Curve& curve) {
    const auto n = double(curve.knob.size());
    double x = 0, y = 0, xx = 0, xy = 0, rest = 0;
    for (size_t i = 0; i < curve.knob.size(); ++i) {
        x += curve.knob[i] / n;
        y += curve.error[i] / n;
    }
    for (size_t i = 0; i < curve.knob.size(); ++i) {
        xx += (curve.knob[i] - x) * (curve.knob[i] - x);
        xy += (curve.knob[i] - x) * (curve.error[i] - y);
    }
    const double slope = xy / xx;
    for (size_t i = 0; i < curve.knob.size(); ++i)
        rest += std::pow(curve.error[i] - y - slope * (curve.knob[i] - x), 2);
    return {slope, std::sqrt(rest / (n - 2) / xx)};
}

constexpr size_t k_fewest_points = 3;
/// One power describes slopes that differ from it by at most this, or this share of it, whichever is more.
constexpr double k_spread = 0.25;

/// `truth` is the truth's own error.
ObservedOrder order_of(const Curve& curve, const std::string& knob, double truth) {
    ObservedOrder order;
    order.knob = knob;
    order.fixed = curve.fixed;
    if (curve.knob.size() < k_fewest_points) {
        order.how =
            fmt::format("{} of {} points have an error clearly above the reference's own; {} are needed",
                        curve.knob.size(), curve.points, k_fewest_points);
        return order;
    }
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i + 1 < curve.knob.size(); ++i) {
        least = std::min(least, slope_between(curve, i));
        most = std::max(most, slope_between(curve, i));
    }
    const auto [slope, deviation] = fit(curve);
    const double towards = curve.knob.back() > curve.knob.front() ? -1 : 1;
    const double allowed = std::max(k_spread, k_spread * std::abs(slope));
    if (!(most - slope <= allowed && slope - least <= allowed)) {
        order.how =
            fmt::format("no single power: between neighbouring points it is {:.2f} to {:.2f}",
                        std::min(towards * least, towards * most), std::max(towards * least, towards * most));
        return order;
    }
    const double smallest = std::exp(*std::ranges::min_element(curve.error));
    const double span = std::abs(curve.knob.back() - curve.knob.front());
    order.order = towards * slope;
    order.uncertainty = std::hypot(deviation, truth / smallest / span);
    order.how = fmt::format("least squares of log error over log {} at {} points, {} to {}", knob,
                            curve.knob.size(), curve.values.front(), curve.values.back());
    return order;
}

} // namespace

void find_idle(WorkPrecisionSet& set, const std::vector<Sight>& sights) {
    const std::vector<std::string> names = set_names(set);
    for (size_t series = 0; series < set.study.series.size(); ++series) {
        std::vector<std::string> idle;
        for (const Axis& axis : set.study.series[series].axes)
            if (is_idle(set, sights, names, series, axis.name)) {
                idle.push_back(axis.name);
                set.idle.push_back({axis.name, set.study.series[series].name});
            }
        if (idle.empty())
            continue;
        for (size_t i = 1; i < set.points.size(); ++i) {
            WorkPrecision& point = set.points[i];
            if (point.point.series != series || !point.measured())
                continue;
            for (size_t k = 0; k < i && !point.idle; ++k)
                point.idle = set.points[k].measured() &&
                             same_but(set, point.point, set.points[k].point, names, idle) &&
                             shows_same(sights[i], sights[k]);
        }
    }
}

namespace {

/// Errors of random samples fall so slowly that a truth is hardly ten times as exact: with too few solid
/// points, those with an error of this many uncertainties of the reference are used for the order, too.
constexpr double k_solid_enough = 3;

bool tells_order(const WorkPrecisionSet& set, const WorkPrecision& point, bool solid) {
    const auto& truth = standard_of(set).uncertainty;
    return solid ? !point.hollow : truth && error_of(set, point.all) >= k_solid_enough * *truth;
}

/// Returns the curves of a series over its last knob.
std::vector<Curve> curves_of(const WorkPrecisionSet& set, size_t series, const std::string& knob,
                             bool solid) {
    std::vector<Curve> curves;
    for (const WorkPrecision& point : set.points) {
        if (point.point.series != series || !point.measured())
            continue;
        std::vector<Setting> fixed = merged(point.point.settings);
        std::erase_if(fixed, [&](const Setting& setting) { return setting.name == knob; });
        auto curve = std::ranges::find(curves, fixed, &Curve::fixed);
        if (curve == curves.end())
            curve = curves.insert(curves.end(), Curve{std::move(fixed), {}, {}, {}, 0});
        ++curve->points;
        const std::string text = value_at(set, point.point, knob);
        const auto value = number_of(text);
        const double error = error_of(set, point.all);
        if (!tells_order(set, point, solid) || !value || !(*value > 0) || !(error > 0) ||
            !std::isfinite(error))
            continue;
        curve->knob.push_back(std::log(*value));
        curve->error.push_back(std::log(error));
        curve->values.push_back(text);
    }
    return curves;
}

} // namespace

void observe_orders(WorkPrecisionSet& set) {
    const double truth = standard_of(set).uncertainty.value_or(0.0);
    for (size_t series = 0; series < set.study.series.size(); ++series) {
        if (set.study.series[series].axes.empty())
            continue;
        const std::string& knob = set.study.series[series].axes.back().name;
        const std::vector<Curve> solid = curves_of(set, series, knob, true),
                                 wider = curves_of(set, series, knob, false);
        for (size_t i = 0; i < solid.size(); ++i)
            if (solid[i].points >= k_fewest_points) {
                const bool enough =
                    solid[i].knob.size() >= k_fewest_points || wider[i].knob.size() < k_fewest_points;
                set.orders.push_back(order_of(enough ? solid[i] : wider[i], knob, truth));
                set.orders.back().series = set.study.series[series].name;
            }
    }
}

std::string to_string(const ObservedOrder& order) {
    std::string where = order.series == order.knob ? "" : fmt::format(" ({})", order.series);
    if (!order.order)
        return fmt::format("no observed order in {}{}: {}", order.knob, where, order.how);
    return fmt::format("observed order in {}{}: {:.2f} +- {:.2f}, {}", order.knob, where, *order.order,
                       std::max(order.uncertainty, 0.005), order.how);
}

} // namespace tidemark::lab
