// What the rays of a frame met, and how wrong that is: from maps of hits to numbers and causes. Pure.
#pragma once

#include "base/extent.hpp"
#include "image/image.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// One entry a pixel, rows from the bottom; several views may stand one behind the other.
struct Hits {
    std::vector<double> distance; ///< world units; -1: nothing met; NaN: no answer
    std::vector<float> evaluations;
    std::vector<uint8_t> flags; ///< glsl::HitFlag

    size_t size() const { return distance.size(); }
};

/// Of several views as of one, in their order.
Hits joined(const std::vector<Hits>& views);
std::vector<double> joined(const std::vector<std::vector<double>>& views);

/// From the RGBA32F picture that mainHit makes. A distance that is NaN, or below 0 but not a miss, is
/// no answer; nor is one whose evaluations are NaN or below 0, which count as 0.
Hits hits_of(const image::Image& image);

/// A first hit that is off by more has met another wave, or stopped on its way to this one.
inline constexpr double k_wrong_distance = 0.1;

/// Over the pixels that have a truth: a reference that gives no answer says nothing of anybody's error.
struct HitErrors {
    size_t pixels = 0;   ///< that have a truth
    size_t no_truth = 0; ///< the others
    size_t both = 0;     ///< pixels where reference and test met something: the next six are over them
    double rms = 0;
    double rms_right = 0; ///< over those of them that are off by at most k_wrong_distance
    double median = 0;
    double p95 = 0;
    double p99 = 0;
    double largest = 0;
    // Parts of these pixels, percent
    double false_miss = 0;
    double false_hit = 0;
    double wrong_hundredth = 0;  ///< false miss or hit, no answer, or off by more than 0.01
    double wrong_tenth = 0;      ///< by more than 0.1
    double most_wrong_tenth = 0; ///< in 95 of 100 cases, where the others are not known
    double wrong_footprint = 0;  ///< by more than the width of a pixel there
    double no_answer = 0;
    // Of all pixels
    double exhausted = 0;
    double negative = 0;
    double evaluations = 0; ///< of the field a pixel
};

/// `footprint` is the width of a pixel at distance 1, one for each pixel. All have the same size.
HitErrors hit_errors(const Hits& reference, const Hits& test, const std::vector<double>& footprint);

/// Why a first hit is wrong by more than 0.1.
enum class Cause : uint8_t {
    right,
    exhaustion, ///< the budget of steps ran out
    sink,       ///< behind the surface, with a sample below it on the way: a step was too long
    tunnel,     ///< behind the surface, with no sample below it: a crest was jumped over
    early,      ///< in front of the surface: accepted too soon
    false_hit,  ///< met something where there is nothing
    no_answer,  ///< NaN or infinity
    no_truth,   ///< nobody knows: the reference gives no answer
};
inline constexpr size_t k_causes = 8;
std::string_view to_string(Cause cause);

std::vector<Cause> causes(const Hits& reference, const Hits& test);

/// How many pixels of each cause.
std::array<size_t, k_causes> count(const std::vector<Cause>& causes);

/// Right pixels dark, each cause in a colour of its own.
image::Image cause_map(const std::vector<Cause>& causes, Extent extent);
/// The colour of a cause in that map, 0..1.
std::array<float, 3> colour_of(Cause cause);

} // namespace tidemark::lab
