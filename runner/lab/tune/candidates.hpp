// Predicts from a study of single settings which combinations are worth measuring: a model, not a
// measurement. Pure.
#pragma once

#include "lab/tune/goal.hpp"
#include "lab/tune/quality_settings.hpp"

#include <vector>

namespace tidemark::lab {

/// Returns a study of the unchanged scene and of the scene with each of these lists of settings. The
/// settings' own axes define the order from coarse to strict.
Study study_of(const std::vector<std::vector<Setting>>& points, const std::vector<QualitySetting>& settings);

/// Returns every value of every setting, with the other settings as in the scene.
std::vector<std::vector<Setting>> single_values(const std::vector<QualitySetting>& settings);

/// Returns combinations that may be best by the goal, along the front of error and time around the target.
/// `explored` is a study of single_values(); `milliseconds` is the unchanged scene's time at the size that
/// the goal's time refers to. The model multiplies time factors, and adds squared errors, or shares of wrong
/// rays.
std::vector<std::vector<Setting>> candidates(const WorkPrecisionSet& explored,
                                             const std::vector<QualitySetting>& settings, const Goal& goal,
                                             double milliseconds);

} // namespace tidemark::lab
