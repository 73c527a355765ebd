// Computes the numbers of an outcome from what a point shows and from the truth. Pure.
#pragma once

#include "image/image.hpp"
#include "lab/hits.hpp"
#include "lab/study/truth.hpp"
#include "lab/study/work_precision.hpp"

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
    std::vector<PixelMask> blind; ///< for each view: the pixels without a truth
    std::vector<Hits> hits;
    std::vector<std::vector<double>> footprints;
};

Outcome outcome_of(const Sight& sight, const Truth& truth, size_t view);

/// Combines the pixels of all views; `views` are their outcomes one by one.
Outcome outcome_of_all(const Sight& sight, const Truth& truth, const std::vector<Outcome>& views);

/// Returns the difference between two sights, over all views.
Share share_of(const std::string& source, const Sight& from, const Sight& to, const Truth& truth);

} // namespace tidemark::lab
