// Numbers of a study from its pictures: errors of a point, idle knobs, observed orders.
//
// Computes the numbers of an outcome from what a point shows and from the truth. Pure.
#pragma once

#include "lab/hits.hpp"
#include "lab/truth.hpp"
#include "lab/work_precision.hpp"
#include "media/image.hpp"

#include <vector>

namespace tidemark::lab {

/// The pictures and hits of a point, one for each view; `hits` is empty if they are not known.
struct Sight {
    std::vector<image::Image> pictures;
    std::vector<Hits> hits;
};

/// The truth of each view. `hits` may be empty.
struct Truth {
    std::vector<image::Image> pictures; ///< empty: no truth is known for the pictures
    std::vector<PixelMask> blind;       ///< for each view: the pixels without a truth
    std::vector<Hits> hits;
    std::vector<std::vector<double>> footprints;
};

Outcome outcome_of(const Sight& sight, const Truth& truth, size_t view);

/// Combines the pixels of all views; `views` are their outcomes one by one.
Outcome outcome_of_all(const Sight& sight, const Truth& truth, const std::vector<Outcome>& views);

/// Returns the difference between two sights, over all views.
Share share_of(const std::string& source, const Sight& from, const Sight& to, const Truth& truth);

// Analyses the points of each curve: knobs that change nothing, and the power by which the error falls. Pure.

/// Records in `set` which knobs change nothing, and which points are idle. `sights` are the pictures and hits
/// of the points, in their order.
void find_idle(WorkPrecisionSet& set, const std::vector<Sight>& sights);

/// Records the observed order of every curve: the slope of its error over its last knob, both as logarithms,
/// by least squares over the points that are not hollow. There is none for fewer than three points, or if the
/// slopes between neighbours differ too much for one power. Call it after judge().
void observe_orders(WorkPrecisionSet& set);

/// For example "order 2.00 +- 0.02 in STEPS (the sum): …".
std::string to_string(const ObservedOrder& order);

} // namespace tidemark::lab
