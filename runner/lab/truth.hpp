// The truth of a study: converged pictures, proved hits, and the remaining error.
//
// Estimates the distance of a ladder of ever stricter settings from its limit, by the change at each rung.
// Pure.
#pragma once

#include "base/measurement.hpp"
#include "lab/hits.hpp"
#include "lab/specimen.hpp"
#include "lab/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The change that all further rungs together would make; nullopt, with the reason, if it cannot be
/// estimated.
struct Remainder {
    std::optional<double> error{};
    std::string how{};  ///< the numbers it comes from, or the reason why there is none
    bool still = false; ///< the last change is only rounding
};

/// `changes` holds the change of each rung from the one before, the strictest last; each rung is stricter by
/// the same factor. The estimate is the sum of the changes to come, extrapolated from their ratios: change r
/// / (1 - r) if the ratio r of the last two stays constant, which is exact for any power of the setting; more
/// if r itself rises, as the third last change shows (exact for powers of the setting's logarithm). It is
/// nullopt if r is 1 or more, and for fewer than two changes. Changes up to `rounding` count as zero.
Remainder remainder_of(const std::vector<double>& changes, double rounding);

// The truths of a study: the hits proved from the scene's text, and the pictures to which the scene
// converges. Needs a current context.

/// If a larger share of a truth's pixels is NaN or infinite, the rest is not accepted as a truth either.
inline constexpr double k_most_blind = 0.1;

/// Adds the pixels that are NaN or infinite, which have no truth, to `blind`.
void add_blind(const image::Image& picture, PixelMask& blind);

/// Returns why the remaining pixels are not accepted as a truth; empty if they are.
std::string too_blind(size_t blind, size_t pixels);

/// The true hits of each view.
struct HitTruth {
    Standard standard;
    std::vector<Hits> views;
    std::vector<std::vector<double>> footprints; ///< for each pixel its width at distance 1
};

struct ProvedHits {
    std::optional<HitTruth> truth{};
    std::string why_not{}; ///< why there is no truth
    bool marches = true;   ///< false: no marching loop was found
};

/// Proves the first zeros of the field of the scene's own march, at the study's strictest settings, from the
/// text (lab/march_hits.hpp).
Result<ProvedHits> proved_hits(const scene::Scene& scene, const Study& study, const KeepGoing& keep_going);

/// The true pictures, and hits for use if no hits are proved.
struct PictureTruth {
    Standard standard;
    std::vector<image::Image> views;
    std::vector<PixelMask> blind; ///< for each view: the pixels without a truth
    std::vector<Hits> hits;       ///< empty without mainHit; NaN: no truth
    Standard hit_standard;
    std::vector<Setting> settings; ///< settings it was drawn with
    glsl::Precision precision = glsl::Precision::single;
    std::string not_promoted; ///< why it is in single precision, if it is
    int step = 0;             ///< of the ladder of ever stricter settings
};

/// Draws the scene with the study's reference settings. If there are none, draws it with the strictest value
/// of every axis, made stricter until the remaining change is small compared with the error of the strictest
/// point. Uses double precision if the scene can be promoted. If `keep_going` returns false, returns the best
/// result so far.
Result<PictureTruth> converged_pictures(const scene::Scene& scene, const Study& study,
                                        const KeepGoing& keep_going);

/// Returns the root mean square difference over the samples of all pictures, without `blind` pixels (by view;
/// empty: none).
double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right,
                   const std::vector<PixelMask>& blind);

/// Returns 1 / height for every pixel, for scenes whose rays are not known.
std::vector<double> plain_footprint(Extent extent);

} // namespace tidemark::lab
