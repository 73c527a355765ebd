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

/// Returns whether `inner` lies within text that `outer` replaces, or both replace the same tokens. Text that
/// `outer` only puts something around can be changed too.
bool is_inside(const glsl::Cure& inner, const glsl::Cure& outer);

// Compares a scene with cuts with the unchanged scene: the error of its pictures, and its share of the time.
// Needs a current context.

/// A cut or a combination is considered if a frame takes at most this share of its former time.
inline constexpr double k_pays = 0.985;

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

/// One program with many cuts, each of which a uniform switches on: one compilation shows what all of them
/// change. Its times say little about a cut's own program.
class CutSwitches {
public:
    /// Compiles those of the cuts `which`, indices into `cuts` of cuts with a switched form, that the
    /// driver accepts. Returns nullopt if there are none, or if `keep_going` ends it.
    static std::optional<CutSwitches> create(const scene::Scene& scene, Extent extent,
                                             std::span<const glsl::Cut> cuts, std::vector<size_t> which,
                                             const KeepGoing& keep_going);

    /// Returns the indices of the accepted cuts, in ascending order.
    const std::vector<size_t>& which() const { return which_; }
    /// Makes the cuts with these indices from the next picture on, and no others.
    void make(std::span<const size_t> cuts);
    Specimen& specimen() { return specimen_; }

    Truth truth{}; ///< the pictures without a cut; set by CutBench::take_as_reference()

private:
    CutSwitches(Specimen specimen, std::vector<size_t> which, std::vector<scene::Knob> knobs, size_t first)
        : specimen_(std::move(specimen)), which_(std::move(which)), knobs_(std::move(knobs)), first_(first) {}
    static std::optional<CutSwitches> link(const scene::Scene& scene, Extent extent,
                                           std::span<const glsl::Cut> cuts, std::vector<size_t> which);

    Specimen specimen_;
    std::vector<size_t> which_;
    std::vector<scene::Knob> knobs_; ///< of the scene, then the switches
    size_t first_;                   ///< index of the first switch
};

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
    /// Seconds to compile the unchanged scene and to draw its first picture.
    double compile_seconds() const { return compile_seconds_; }
    /// Seconds to draw one view of it; rough.
    double draw_seconds() const { return draw_seconds_; }
    /// Draws the switches without a cut, for error_of_switched(). Returns false if that exceeds the goal.
    bool take_as_reference(CutSwitches& switches, const Goal& goal);
    /// Returns the error of the cuts in the worst view, or nullopt if it exceeds the goal. The other views do
    /// not count.
    std::optional<double> error_of_switched(CutSwitches& switches, std::span<const size_t> cuts,
                                            const Goal& goal);
    /// Returns the time with the cut switched on, as a share of the time without; rough.
    double time_of_switched(CutSwitches& switches, size_t cut);
    /// Draws the scene with the cuts, and times it against `other`. Returns nullopt if the cuts cannot be
    /// made, the driver rejects the text, or the error exceeds the goal in the whole picture or in a part.
    /// If the cuts save time, the other views count, too, unless `everywhere` is false.
    std::optional<CutTrial> try_cuts(std::span<const glsl::Cure> cuts, Specimen& other, const Goal& goal,
                                     bool everywhere = true);

private:
    CutBench(const scene::Scene& scene, Extent extent, std::vector<View> views, Specimen own);

    /// Returns the CPU time if the CPU draws, else the wall time.
    double clocked(const Elapsed& elapsed) const;
    double relative_time(Specimen& one, Specimen& other) const;
    std::optional<double> error_in(Specimen& specimen, std::span<const View> views, const Truth& truth,
                                   const Goal& goal) const;

    const scene::Scene* scene_;
    Extent extent_;
    std::vector<View> views_;
    Specimen own_;
    bool by_cpu_; ///< other work of the machine does not count
    Truth truth_{};

    double compile_seconds_ = 0, draw_seconds_ = 0;
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
    double error = 0; ///< of this cut alone, in the search pictures
    /// The time of a frame with this cut alone, as a share of the time without it; NaN if it was not timed.
    double time = 1;
    bool hangs_on_size = false; ///< see glsl::Cut
};

struct Simplified : SearchOutcome {
    std::vector<ChosenCut> chosen{}; ///< in the order of their combination; empty: no cut pays
};

/// Fails (ErrorCode::check_failed) if nothing can be measured, for example if the picture is NaN or infinite.
Result<Simplified> simplify(const scene::Scene& scene, const SimplifyRequest& request, const Watch& watch,
                            const Circumstances& circumstances);

} // namespace tidemark::lab
