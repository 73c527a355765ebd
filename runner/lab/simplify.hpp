// `tidemark simplify`: possible cuts, trials of cuts, and the search for the best combination.
//
// Finds the cuts that a scene's texts allow, over all passes. Needs a current context.
#pragma once

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "lab/outcome.hpp"
#include "lab/specimen.hpp"
#include "lab/study.hpp"
#include "lab/tune.hpp"
#include "scene/scene.hpp"
#include "shader/cuts.hpp"
#include "shader/source_edits.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

struct CutPlaces {
    std::vector<glsl::Cut> cuts;     ///< those with the most work first
    std::vector<std::string> left{}; ///< sentences: code that was not examined, and why
};

/// Expressions that a number could replace get the mean of their values in these views, drawn at that size.
Result<CutPlaces> find_cuts(const scene::Scene& scene, const std::vector<View>& views, Extent extent,
                            const KeepGoing& keep_going);

/// Returns whether `inner` lies within the text that `outer` removes or changes, or is the same text.
bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer);

// Compares a scene with cuts with the unchanged scene: the error of its pictures, and its share of the time.
// Needs a current context.

struct CutTrial {
    Specimen specimen;
    double error = 0; ///< in the worst view; 0: all bytes of the floats are equal
    double time = 1;  ///< of a frame, as a share of the other scene's
};

/// Returns whether the error in each part of the picture is at most 3 times the goal for the whole picture: a
/// small object that is missing hardly changes the mean. A difference counts only as far as a value lies
/// outside of those of the other picture's 3x3 pixels there: an edge may move by one pixel.
bool keeps_parts(const Goal& goal, const image::Image& own, const image::Image& cut);

/// Returns moments and places of the mouse at which a cut may show although it does not in `views`: those
/// that the numbers of the text point to, and others spread evenly. Of a scene whose frames depend on earlier
/// ones only moments up to the last of `views`. At most `most`.
std::vector<View> other_views(const scene::Scene& scene, const std::vector<View>& views, size_t most);

class CutBench {
public:
    /// Draws the unchanged scene in `views` and, for at most `seconds`, in its other_views(). Fails
    /// (ErrorCode::check_failed) if its picture is NaN or infinite.
    static Result<CutBench> create(const scene::Scene& scene, Extent extent, std::vector<View> views,
                                   double seconds);

    Specimen& own() { return own_; }
    /// Returns the time for one view of the unchanged scene, averaged over the views.
    double milliseconds();
    /// Estimates the seconds of a trial whose cuts save nothing.
    double seconds_of_trial();
    /// Returns in how many views a cut that saves time is also drawn.
    size_t other_view_count() const { return other_views_.size(); }
    /// Draws the scene with the cuts, and times it against `other`. Returns nullopt if the cuts cannot be
    /// made, the driver rejects the text, or the error exceeds the goal in the whole picture or in a part.
    /// If the cuts save time, the other views count, too.
    std::optional<CutTrial> try_cuts(std::span<const glsl::Cure> cuts, Specimen& other, const Goal& goal);

private:
    CutBench(const scene::Scene& scene, Extent extent, std::vector<View> views, Specimen own)
        : scene_(&scene), extent_(extent), views_(std::move(views)), own_(std::move(own)) {}

    double relative_time(Specimen& one, Specimen& other) const;
    std::optional<double> error_in(Specimen& specimen, std::span<const View> views, const Truth& truth,
                                   const Goal& goal) const;

    const scene::Scene* scene_;
    Extent extent_;
    std::vector<View> views_;
    Specimen own_;
    Truth truth_{};
    std::vector<View> other_views_{};
    std::vector<Truth> other_truths_{}; ///< one per other view
};

// Finds what can be left out of a scene within a stated error: cuts of its texts, each drawn and timed,
// combined as long as the picture stays close to the unchanged scene's, and judged at moments that the search
// did not use. Needs a current context.

/// The error is measured against the unchanged scene; 0: all bytes stay the same.
struct SimplifyRequest : SearchRequest {
    std::function<bool(const glsl::Cure&)> can_be_written; ///< to the scene's own files
};

/// A cut that was chosen.
struct ChosenCut {
    glsl::Cure change;
    double error = 0;           ///< of this cut alone, in the search pictures
    double time = 1;            ///< of a frame with this cut alone, as a share of the time without it
    bool hangs_on_size = false; ///< see glsl::Cut
};

struct Simplified : SearchOutcome {
    std::vector<ChosenCut> chosen{}; ///< in the order of their combination; empty: no cut pays
};

/// Fails (ErrorCode::check_failed) if nothing can be measured, for example if the picture is NaN or infinite.
Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances);

} // namespace tidemark::lab
