// The truths of a study: what rays really meet, from a march with a proof, and what pictures converge to. A
// context must be current.
#pragma once

#include "lab/fields/reference.hpp"
#include "lab/hits.hpp"
#include "lab/study/specimen.hpp"
#include "lab/study/work_precision.hpp"
#include "lab/watch.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

/// The truth about the hits of each view.
struct HitTruth {
    Standard standard;
    std::vector<Hits> views;
    std::vector<std::vector<double>> footprints; ///< width of a pixel at distance 1, one for each pixel
    std::vector<Reference> references;           ///< of each view, where there is one in double
};

/// Marches the scene's reference in double, for scenes that have one (lab/fields/reference.hpp). Nothing: it
/// has none, or it was stopped.
Result<std::optional<HitTruth>> certified_hits(const scene::Scene& scene, const Study& study,
                                               const KeepGoing& keep_going);

/// The truth about the pictures, and about the hits where there is nothing better.
struct PictureTruth {
    Standard standard;
    std::vector<image::Image> views;
    std::vector<Hits> hits; ///< empty without mainHit
    Standard hit_standard;
    std::vector<Setting> settings; ///< that it was drawn with
    glsl::Precision precision = glsl::Precision::single;
    std::string not_promoted; ///< why it is in single precision, where it is
};

/// Draws the scene with the study's reference settings or, without any, with the strictest value of every
/// axis, made stricter until the picture stays the same; then once more with these settings in double
/// precision, which is the truth where the scene can be promoted. `keep_going` false: the best so far.
Result<PictureTruth> converged_pictures(const scene::Scene& scene, const Study& study,
                                        const KeepGoing& keep_going);

/// Root of the mean square over the samples of all pictures.
double pooled_rmse(const std::vector<image::Image>& left, const std::vector<image::Image>& right);

/// One part of the height for every pixel: for scenes whose rays are not known.
std::vector<double> plain_footprint(Extent extent);

} // namespace tidemark::lab
