// Finds the cuts that a scene's texts allow, over all passes. Needs a current context.
#pragma once

#include "base/result.hpp"
#include "glsl/cut/cuts.hpp"
#include "lab/study/view.hpp"
#include "lab/watch.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

struct CutPlaces {
    std::vector<glsl::Cut> cuts; ///< those with the most work first
    std::vector<std::string> left{}; ///< sentences: code that was not examined, and why
};

/// Expressions that a number could replace get the mean of their values in these views, drawn at that size.
Result<CutPlaces> find_cuts(const scene::Scene& scene, const std::vector<View>& views, Extent extent,
                            const KeepGoing& keep_going);

/// Returns whether `inner` lies within the text that `outer` removes or changes, or is the same text.
bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer);

} // namespace tidemark::lab
