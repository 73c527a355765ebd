// The hits of a frame's rays and their errors: hit maps in, numbers and causes of error out. Pure.
#pragma once

#include "base/extent.hpp"
#include "media/image.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// The hits of a picture: one entry per pixel, rows from the bottom. Several views may be concatenated.
struct Hits {
    std::vector<double> distance; ///< world units; -1: no hit; NaN: invalid
    std::vector<float> evaluations;
    std::vector<uint8_t> flags; ///< glsl::HitFlag

    size_t size() const { return distance.size(); }
};

/// Concatenates the hits of several views, in their order.
Hits joined(const std::vector<Hits>& views);
std::vector<double> joined(const std::vector<std::vector<double>>& views);

/// Reads the hits from the RGBA32F picture that mainHit draws. A distance is invalid (NaN) if it is NaN,
/// infinite, or negative but not -1, or if its number of evaluations is NaN, infinite or negative; such a
/// number becomes 0.
Hits hits_of(const image::Image& image);

/// Distance error above which a hit counts as wrong: it lies on another wave, or the march stopped before the
/// surface.
inline constexpr double k_wrong_distance = 0.1;

/// Errors over the pixels whose reference hit is valid. The other pixels count only in `no_truth` and in the
/// last three fields.
struct HitErrors {
    size_t pixels = 0;   ///< pixels with a valid reference
    size_t no_truth = 0; ///< pixels without one
    size_t both = 0;     ///< pixels with a hit in both reference and test; the next six fields are over these
    double rms = 0;
    double rms_right = 0; ///< over those whose error is at most k_wrong_distance
    double median = 0;
    double p95 = 0;
    double p99 = 0;
    double largest = 0;
    // Percent of `pixels`:
    double false_miss = 0;
    double false_hit = 0;
    double wrong_hundredth = 0; ///< missed hit, false hit, invalid, or an error above 0.01
    double wrong_tenth = 0;     ///< the same with an error above 0.1
    /// Upper 95 % bound of `wrong_tenth` if `no_truth` is not 0, else equal to it.
    double most_wrong_tenth = 0;
    double least_wrong_tenth = 0; ///< the lower bound
    double wrong_footprint = 0;   ///< the same with an error above the width of a pixel at that distance
    double no_answer = 0;
    // Percent of all pixels:
    double exhausted = 0;
    double negative = 0;
    double evaluations = 0; ///< mean number of field evaluations per pixel
};

/// Compares two sets of hits of the same size. `footprint` is the width of each pixel at distance 1.
HitErrors hit_errors(const Hits& reference, const Hits& test, const std::vector<double>& footprint);

/// The cause of a hit's error of more than k_wrong_distance.
enum class Cause : uint8_t {
    right,
    exhaustion, ///< the step budget ran out
    sink,       ///< past the surface or missed, after a sample below the surface: a step was too long
    tunnel,     ///< past the surface or missed, without a sample below it: a step jumped over a crest
    early,      ///< closer than the surface: accepted too soon
    false_hit,  ///< a hit where the reference has none
    no_answer,  ///< the test's distance is NaN or invalid
    no_truth,   ///< the reference is invalid
};
inline constexpr size_t k_causes = 8;
std::string_view to_string(Cause cause);

std::vector<Cause> causes(const Hits& reference, const Hits& test);

/// Returns the number of pixels of each cause.
std::array<size_t, k_causes> count(const std::vector<Cause>& causes);

/// Draws a map of causes, RGB floats: right pixels dark, each cause in its own colour.
image::Image cause_map(const std::vector<Cause>& causes, Extent extent);
/// Returns the colour of a cause in that map, 0..1.
std::array<float, 3> colour_of(Cause cause);

} // namespace tidemark::lab
