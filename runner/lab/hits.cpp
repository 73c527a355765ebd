#include "lab/hits.hpp"

#include "base/measurement.hpp"
#include "shader/survey.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

constexpr double k_miss = -1.0;

bool met(double distance) {
    return distance >= 0;
}

double percent(size_t part, size_t whole) {
    return whole == 0 ? 0.0 : 100.0 * double(part) / double(whole);
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// Returns whether the test is invalid, hits where the reference misses or the reverse, or is off by more
/// than `tolerance`.
bool wrong(double reference, double test, double tolerance) {
    if (std::isnan(test) || met(reference) != met(test))
        return true;
    return met(test) && std::abs(test - reference) > tolerance;
}

Cause cause_of(double reference, double test, int flags) {
    if (std::isnan(reference))
        return Cause::no_truth;
    if (!wrong(reference, test, k_wrong_distance))
        return Cause::right;
    if (std::isnan(test))
        return Cause::no_answer;
    if (flags & glsl::k_hit_exhausted)
        return Cause::exhaustion;
    if (!met(reference))
        return Cause::false_hit;
    if (met(test) && test < reference)
        return Cause::early;
    return flags & glsl::k_hit_negative ? Cause::sink : Cause::tunnel;
}

} // namespace

Hits joined(const std::vector<Hits>& views) {
    Hits all;
    for (const Hits& view : views) {
        append(all.distance, view.distance);
        append(all.evaluations, view.evaluations);
        append(all.flags, view.flags);
    }
    return all;
}

std::vector<double> joined(const std::vector<std::vector<double>>& views) {
    std::vector<double> all;
    for (const auto& view : views)
        append(all, view);
    return all;
}

Hits hits_of(const image::Image& image) {
    assert(image.type == image::SampleType::f32 && image.channels == 4);
    Hits hits;
    const auto samples = image.f32();
    for (size_t i = 0; i < samples.size(); i += 4) {
        const float t = samples[i], evaluations = samples[i + 1], flags = samples[i + 3];
        const bool counted = std::isfinite(evaluations) && evaluations >= 0;
        const bool answer = counted && std::isfinite(t) && (t >= 0 || t == float(k_miss));
        hits.distance.push_back(answer ? double(t) : std::numeric_limits<double>::quiet_NaN());
        hits.evaluations.push_back(counted ? evaluations : 0.0f);
        hits.flags.push_back(flags >= 0 && flags < 256 ? uint8_t(flags) : uint8_t{0});
    }
    return hits;
}

HitErrors hit_errors(const Hits& reference, const Hits& test, const std::vector<double>& footprint) {
    assert(reference.size() == test.size() && footprint.size() == test.size());
    HitErrors errors;
    std::vector<double> differences;
    size_t false_miss = 0, false_hit = 0, hundredth = 0, tenth = 0, pixel = 0, exhausted = 0, negative = 0,
           none = 0;
    double squares = 0, right_squares = 0, evaluations = 0;
    size_t right = 0;
    for (size_t i = 0; i < test.size(); ++i) {
        const double expected = reference.distance[i], found = test.distance[i];
        evaluations += double(test.evaluations[i]);
        exhausted += (test.flags[i] & glsl::k_hit_exhausted) != 0;
        negative += (test.flags[i] & glsl::k_hit_negative) != 0;
        if (std::isnan(expected)) {
            ++errors.no_truth;
            continue;
        }
        ++errors.pixels;
        none += std::isnan(found);
        false_miss += met(expected) && found == k_miss;
        false_hit += !met(expected) && met(found);
        hundredth += wrong(expected, found, 0.01);
        tenth += wrong(expected, found, k_wrong_distance);
        pixel += wrong(expected, found, footprint[i] * std::max(expected, 0.0));
        if (!met(expected) || !met(found))
            continue;
        differences.push_back(std::abs(found - expected));
        const double square = differences.back() * differences.back();
        squares += square;
        if (wrong(expected, found, k_wrong_distance))
            continue;
        ++right;
        right_squares += square;
    }
    errors.both = differences.size();
    if (errors.both > 0) {
        std::sort(differences.begin(), differences.end());
        const auto at = [&](double part) { return quantile_of_sorted(differences, part); };
        errors.rms = std::sqrt(squares / double(errors.both));
        errors.rms_right = right == 0 ? 0.0 : std::sqrt(right_squares / double(right));
        errors.median = at(0.5);
        errors.p95 = at(0.95);
        errors.p99 = at(0.99);
        errors.largest = differences.back();
    }
    errors.false_miss = percent(false_miss, errors.pixels);
    errors.false_hit = percent(false_hit, errors.pixels);
    errors.wrong_hundredth = percent(hundredth, errors.pixels);
    errors.wrong_tenth = percent(tenth, errors.pixels);
    errors.most_wrong_tenth =
        errors.no_truth == 0 ? errors.wrong_tenth : 100 * most_of_share(tenth, errors.pixels);
    errors.least_wrong_tenth = errors.no_truth == 0
                                   ? errors.wrong_tenth
                                   : 100 * (1 - most_of_share(errors.pixels - tenth, errors.pixels));
    errors.wrong_footprint = percent(pixel, errors.pixels);
    errors.no_answer = percent(none, errors.pixels);
    errors.exhausted = percent(exhausted, test.size());
    errors.negative = percent(negative, test.size());
    errors.evaluations = test.size() == 0 ? 0.0 : evaluations / double(test.size());
    return errors;
}

std::string_view to_string(Cause cause) {
    switch (cause) {
    case Cause::right: return "right";
    case Cause::exhaustion: return "exhaustion";
    case Cause::sink: return "sink";
    case Cause::tunnel: return "tunnel";
    case Cause::early: return "stopped early";
    case Cause::false_hit: return "false hit";
    case Cause::no_answer: return "no answer";
    case Cause::no_truth: break;
    }
    return "no truth";
}

std::array<float, 3> colour_of(Cause cause) {
    switch (cause) {
    case Cause::right: return {0.10f, 0.11f, 0.13f};
    case Cause::exhaustion: return {0.90f, 0.62f, 0.00f};
    case Cause::sink: return {0.34f, 0.71f, 0.91f};
    case Cause::tunnel: return {0.80f, 0.47f, 0.65f};
    case Cause::early: return {0.94f, 0.89f, 0.26f};
    case Cause::false_hit: return {0.84f, 0.37f, 0.00f};
    case Cause::no_answer: return {1.0f, 1.0f, 1.0f};
    case Cause::no_truth: break;
    }
    return {0.45f, 0.46f, 0.48f};
}

std::vector<Cause> causes(const Hits& reference, const Hits& test) {
    std::vector<Cause> found;
    for (size_t i = 0; i < test.size(); ++i)
        found.push_back(cause_of(reference.distance[i], test.distance[i], test.flags[i]));
    return found;
}

std::array<size_t, k_causes> count(const std::vector<Cause>& causes) {
    std::array<size_t, k_causes> counts{};
    for (const Cause cause : causes)
        ++counts[size_t(cause)];
    return counts;
}

image::Image cause_map(const std::vector<Cause>& causes, Extent extent) {
    image::Image image(extent, 3, image::SampleType::f32);
    for (size_t i = 0; i < causes.size(); ++i)
        std::ranges::copy(colour_of(causes[i]), image.f32().begin() + ptrdiff_t(3 * i));
    return image;
}

} // namespace tidemark::lab
