// The cuts that a scene's texts allow, passes taken together. A context must be current.
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
    std::vector<glsl::Cut> cuts;     ///< the most work first
    std::vector<std::string> left{}; ///< sentences: what was not looked at, and why
};

/// What numbers could stand for has the mean of its values in these views, drawn at that size.
Result<CutPlaces> find_cuts(const scene::Scene& scene, const std::vector<View>& views, Extent extent,
                            const KeepGoing& keep_going);

/// Whether `inner` is a part of the words that `outer` takes away or changes, or the same.
bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer);

} // namespace tidemark::lab
