// Compares a scene with cuts with the unchanged scene: the error of its pictures, and its share of the time.
// Needs a current context.
#pragma once

#include "glsl/cure/cure.hpp"
#include "lab/study/outcome.hpp"
#include "lab/study/specimen.hpp"
#include "lab/tune/goal.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tidemark::lab {

struct CutTrial {
    Specimen specimen;
    double error = 0; ///< in the worst view; 0: all bytes of the floats are equal
    double time = 1; ///< of a frame, as a share of the other scene's
};

/// Returns whether the error in each part of the picture is at most 3 times the goal for the whole picture: a
/// small object that is missing hardly changes the mean.
bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut);

class CutBench {
public:
    /// Draws the unchanged scene. Fails (ErrorCode::check_failed) if its picture is NaN or infinite.
    static Result<CutBench> create(const scene::Scene& scene, Extent extent, std::vector<View> views);

    Specimen& own() { return own_; }
    /// Returns the time for one view of the unchanged scene, averaged over the views.
    double milliseconds();
    /// Estimates the seconds of a trial whose cuts save nothing.
    double seconds_of_trial();
    /// Draws the scene with the cuts, and times it against `other`. Returns nullopt if the cuts cannot be
    /// made, the driver rejects the text, or the error exceeds the goal in the whole picture or in a part.
    std::optional<CutTrial> try_cuts(std::span<const glsl::Cure> cuts, Specimen& other, const Goal& goal);

private:
    CutBench(const scene::Scene& scene, Extent extent, std::vector<View> views, Specimen own)
        : scene_(&scene), extent_(extent), views_(std::move(views)), own_(std::move(own)) {}

    double relative_time(Specimen& one, Specimen& other) const;

    const scene::Scene* scene_;
    Extent extent_;
    std::vector<View> views_;
    Specimen own_;
    Truth truth_;
};

} // namespace tidemark::lab
