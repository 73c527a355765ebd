// The truths of a study: what rays really meet, proved from the scene's text, and what pictures converge to.
// A context must be current.
#pragma once

#include "lab/hits.hpp"
#include "lab/study/specimen.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Where more of a truth's pixels are NaN or infinite, the rest is no truth either.
inline constexpr double k_most_blind = 0.1;

/// Adds the pixels that are NaN or infinite: those that have no truth.
void add_blind(const image::Image& picture, PixelMask& blind);

/// Why the rest of the pixels is no truth either; empty: it is.
std::string too_blind(size_t blind, size_t pixels);

/// The truth about the hits of each view.
struct HitTruth {
    Standard standard;
    std::vector<Hits> views;
    std::vector<std::vector<double>> footprints; ///< width of a pixel at distance 1, one for each pixel
};

struct ProvedHits {
    std::optional<HitTruth> truth{};
    std::string why_not{}; ///< where there is none
    bool marches = true;   ///< false: no loop is found that does
};

/// The first zeros of the field of the scene's own march, at the study's strictest settings, proved from the
/// text (lab/march/true_hits.hpp).
Result<ProvedHits> proved_hits(const scene::Scene& scene, const Study& study, const KeepGoing& keep_going);

/// The truth about the pictures, and about the hits where there is nothing better.
struct PictureTruth {
    Standard standard;
    std::vector<image::Image> views;
    std::vector<PixelMask> blind; ///< of each view: pixels that have no truth
    std::vector<Hits> hits;       ///< empty without mainHit; NaN: no truth
    Standard hit_standard;
    std::vector<Setting> settings; ///< that it was drawn with
    glsl::Precision precision = glsl::Precision::single;
    std::string not_promoted; ///< why it is in single precision, where it is
};

/// Draws the scene with the study's reference settings or, without any, with the strictest value of every
/// axis, made stricter until what further steps would change is small beside the error of the strictest
/// point; in double precision where the scene can be promoted. `keep_going` false: the best so far.
Result<PictureTruth> converged_pictures(const scene::Scene& scene, const Study& study,
                                        const KeepGoing& keep_going);

/// Root of the mean square over the samples of all pictures, but for `blind` pixels (by view; empty: none).
double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right,
                   const std::vector<PixelMask>& blind);

/// One part of the height for every pixel: for scenes whose rays are not known.
std::vector<double> plain_footprint(Extent extent);

} // namespace tidemark::lab
