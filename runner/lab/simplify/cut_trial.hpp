// A scene with cuts against the same scene as it is: how far its pictures are off, and what part of the time
// it takes. A context must be current.
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
    double error = 0; ///< in the worst view; 0: every byte of the floats is the same
    double time = 1;  ///< of a frame, as a part of the other scene's
};

/// Whether no part of the picture is much further off than the goal allows for the whole of it: a small thing
/// that is gone is little in a mean.
bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut);

class CutBench {
public:
    /// Draws the scene as it is. Fails (ErrorCode::check_failed) where its picture is NaN or infinite.
    static Result<CutBench> create(const scene::Scene& scene, Extent extent, std::vector<View> views);

    Specimen& own() { return own_; }
    /// Of a view of the scene as it is, in the mean.
    double milliseconds();
    /// Of cuts that save nothing, guessed.
    double seconds_of_trial();
    /// Timed against `other`. Nothing where the cuts cannot be made, where the driver refuses the text, and
    /// where the error is more than the goal's, of the whole or of a part.
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
