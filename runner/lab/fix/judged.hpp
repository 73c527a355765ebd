// A scene before and after a cure, drawn in the same situations: whether it is better, and by what. A context
// must be current.
#pragma once

#include "lab/fix/finding.hpp"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::lab {

/// How often the fault is there.
struct Fault {
    std::string of; ///< "pixels that are not finite"
    double before = 0, after = 0;
};

struct Judgement {
    Fault fault;
    size_t compared = 0;      ///< pixels that were finite before, over all passes and situations
    size_t changed = 0;       ///< of these, those with other bytes
    double largest_share = 0; ///< of changed pixels in one situation
    double flip = 0;          ///< the largest mean over the situations whose pictures are finite
    /// RMSE of the picture in floats against that in double, over what is finite in both.
    std::optional<double> error_before{}, error_after{};
    /// CPU of a frame, the median of frames drawn in turns; none of a scene that reads what it drew.
    std::optional<double> milliseconds_before{}, milliseconds_after{};
};

/// A picture in floats and in doubles.
struct InBoth {
    image::Image floats, doubles;

    double gap(size_t sample) const { return double(floats.f32()[sample]) - double(doubles.f32()[sample]); }
};

/// The pictures of a scene in the situations that cures are judged in.
class DrawnScene {
public:
    DrawnScene(const scene::Scene& scene, const Promises& promises) : bench_(scene, promises) {}

    ProbeBench& bench() { return bench_; }
    /// Image in floats and in doubles. Fails where it has no doubles.
    Result<InBoth> in_both(const FrameState& state);
    /// All passes in a situation; kept.
    Result<const std::vector<PassPicture>*> passes(const FrameState& state);
    /// How much of the fault is there. Fails where the scene does not compile.
    Result<double> fault(const Finding& finding, const std::vector<PictureView>& views);

private:
    Result<double> fault_of_scene(Finding::Kind kind, const std::vector<PictureView>& views);

    ProbeBench bench_;
    std::deque<std::pair<FrameState, std::vector<PassPicture>>> drawn_{};
    std::deque<std::pair<FrameState, InBoth>> in_both_{};
    std::map<Finding::Kind, double> faults_{}; ///< that the whole scene has
};

/// Nothing where the cured scene is not surely better: the fault is not less, another pixel is not finite any
/// more, a picture changes that should not, or doubles know another value for what was not finite.
Result<std::optional<Judgement>> judge(DrawnScene& before, DrawnScene& after, const Finding& finding,
                                       const std::vector<PictureView>& views);

} // namespace tidemark::lab
