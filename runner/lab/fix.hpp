// Fixes for `check --fix`: the faults that may be fixed, the judgement of a fix, and the loop over all of
// them.
//
// Finds faults in a scene for which fixes of the text may be known: places and candidate changes. It judges
// none of them. A context must be current.
#pragma once

#include "lab/exploration.hpp"
#include "lab/probe_bench.hpp"
#include "shader/source_edits.hpp"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

struct Finding {
    enum class Kind {
        no_value,   ///< a variable is read before it is set
        not_finite, ///< a picture has a NaN or an infinity
        undefined,  ///< a function outside its domain, visible in the picture
        first_hit,  ///< rays proved to step over their first hit or to miss it
        budget,     ///< rays that run out of steps
        counter,    ///< a loop with a float counter that miscounts
        divergence, ///< a derivative where neighbouring pixels may have taken another branch
        rounding,   ///< a picture in float that differs from that in double
        hash,       ///< random numbers from large sines
        bounds,     ///< an index, a shift, a division by 0, a texel or a conversion out of bounds
        remainder,  ///< an integer division of a negative number
        edges,      ///< clamp or smoothstep with edges in the wrong order
        seam,       ///< a mipmap chosen across a jump of the coordinates
    };
    Kind kind = Kind::no_value;
    std::string sentence;              ///< the fault and its place
    std::optional<FrameState> where{}; ///< a situation that shows it
    std::vector<glsl::Cure> cures{};   ///< the simplest first; empty: none is known
};

struct CurableFindings {
    std::vector<Finding> all;
    std::vector<PictureView> views; ///< in which undefined calls were measured
    std::string left_out{};         ///< why the text was not analysed; empty: it was
};

/// Runs the analyses and probes that fixes exist for. `hashes`: also hashes of large sines, whose fixes
/// change the picture.
Result<CurableFindings> find_curable(ProbeBench& bench, bool hashes);

// Compares a scene before and after a fix in the same situations: whether it is better, and by how much. A
// context must be current.

/// The amount of a fault before and after a fix.
struct Fault {
    std::string of; ///< "pixels that are not finite"
    double before = 0, after = 0;
};

struct Judgement {
    Fault fault;
    size_t compared = 0;      ///< pixels that were finite before, over all passes and situations
    size_t changed = 0;       ///< those of them with other bytes
    double largest_share = 0; ///< largest share of changed pixels in one situation
    double flip = 0;          ///< largest mean FLIP over the situations whose pictures are finite
    /// RMSE of the picture in float against that in double, over the samples that are finite in all four
    /// pictures.
    std::optional<double> error_before{}, error_after{};
    /// Median CPU time of a frame, measured alternately; none for scenes with feedback.
    std::optional<double> milliseconds_before{}, milliseconds_after{};
};

/// A picture in float and in double.
struct InBoth {
    image::Image floats, doubles;

    double gap(size_t sample) const { return double(floats.f32()[sample]) - double(doubles.f32()[sample]); }
};

/// How far pictures in float are from those in double, as shown: colours are clamped to 0 to 1.
struct ShownError {
    double rmse = 0;   ///< over the colours that are finite in both
    double worst = 0;  ///< largest difference of such a colour
    size_t pixels = 0; ///< compared, in all pictures
};

/// The pictures of a scene in the situations that fixes are judged in, kept after they are drawn.
class DrawnScene {
public:
    DrawnScene(const scene::Scene& scene, const Promises& promises) : bench_(scene, promises) {}

    ProbeBench& bench() { return bench_; }
    /// Returns Image in float and in double. Fails if the scene cannot be promoted.
    Result<InBoth> in_both(const FrameState& state);
    /// Returns the error of Image over three ordinary moments: 0, 1 and 10 s. Fails as `in_both`, or if no
    /// colour is finite.
    Result<ShownError> shown_error();
    /// Returns all passes in a situation; the pictures stay valid as long as this object.
    Result<const std::vector<PassPicture>*> passes(const FrameState& state);
    /// Returns the amount of the fault. Fails if the scene does not compile.
    Result<double> fault(const Finding& finding, const std::vector<PictureView>& views);

private:
    Result<double> fault_of_scene(Finding::Kind kind, const std::vector<PictureView>& views);

    ProbeBench bench_;
    std::deque<std::pair<FrameState, std::vector<PassPicture>>> drawn_{};
    std::deque<std::pair<FrameState, InBoth>> in_both_{};
    std::map<Finding::Kind, double> faults_{}; ///< of faults that do not depend on a situation
};

/// Returns nothing unless the fixed scene is surely better: nothing if the fault remains, a finite pixel
/// becomes non-finite, a picture changes that should not, or the picture in double contradicts the new values
/// of non-finite pixels.
Result<std::optional<Judgement>> judge(DrawnScene& before, DrawnScene& after, const Finding& finding,
                                       const std::vector<PictureView>& views);

// Fixes the faults that probes find in a scene, one after the other. Each fix is drawn on top of those before
// it, and only one that improves the scene is offered. It writes no files. A context must be current.

struct Offer {
    std::string finding;
    Judgement judgement;
};

/// A fault that was found and not fixed, with the reason.
struct Remaining {
    std::string finding;
    std::string why;
};

struct Mending {
    bool hashes = false; ///< also fix hashes of large sines, which changes the picture
    /// Called first, with the error of the unchanged scene (DrawnScene::shown_error). Empty: it is not
    /// measured.
    std::function<void(const Result<ShownError>& error)> measured{};
    /// Returns whether the files can be changed by all of `cures`, the new one last.
    std::function<bool(std::span<const glsl::Cure> cures)> can_be_written;
    /// Called with each fix; the last of `cures` is the new one.
    std::function<void(const Offer& offer, std::span<const glsl::Cure> cures)> offered;
    std::function<void(const Remaining& remaining)> remains;
};

/// Repeats analysis and fixes until a round has no new fix, at most eight times.
Result<void> mend(const scene::Scene& scene, const Promises& promises, const Mending& mending);

} // namespace tidemark::lab
