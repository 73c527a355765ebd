// From a study of single settings to combinations that are worth measuring: a model, no measurement. Pure.
#pragma once

#include "lab/tune/goal.hpp"
#include "lab/tune/quality_settings.hpp"

#include <vector>

namespace tidemark::lab {

/// The scene with these settings, each point by itself, and as it is. What counts as strict is the settings'
/// to say.
Study study_of(const std::vector<std::vector<Setting>>& points, const std::vector<QualitySetting>& settings);

/// Every value of every setting, the others as the scene has them.
std::vector<std::vector<Setting>> single_values(const std::vector<QualitySetting>& settings);

/// Combinations that may be the best by the goal, along the front of error and time around what is wanted.
/// `explored` is a study of single_values(), `milliseconds` what the scene as it is takes where the goal's
/// time holds. Factors of time are taken to multiply; of errors squares to add, and shares of wrong rays.
std::vector<std::vector<Setting>> candidates(const WorkPrecisionSet& explored,
                                             const std::vector<QualitySetting>& settings, const Goal& goal,
                                             double milliseconds);

} // namespace tidemark::lab
