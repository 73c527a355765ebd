// Compares a scene before and after a fix in the same situations: whether it is better, and by how much. A
// context must be current.
#pragma once

#include "lab/fix/finding.hpp"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

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

/// The pictures of a scene in the situations that fixes are judged in, kept after they are drawn.
class DrawnScene {
public:
    DrawnScene(const scene::Scene& scene, const Promises& promises) : bench_(scene, promises) {}

    ProbeBench& bench() { return bench_; }
    /// Returns Image in float and in double. Fails if the scene cannot be promoted.
    Result<InBoth> in_both(const FrameState& state);
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

} // namespace tidemark::lab
