// From what a point shows and what is true to the numbers of its outcome. Pure.
#pragma once

#include "image/image.hpp"
#include "lab/hits.hpp"
#include "lab/study/truth.hpp"
#include "lab/study/work_precision.hpp"

#include <vector>

namespace tidemark::lab {

/// What a point shows on each view; `hits` is empty where they are not known.
struct Sight {
    std::vector<image::Image> pictures;
    std::vector<Hits> hits;
};

/// The truth about each view. `hits` may be empty.
struct Truth {
    std::vector<image::Image> pictures; ///< empty: there is no truth about them
    std::vector<PixelMask> blind;       ///< of each view: pixels that have none
    std::vector<Hits> hits;
    std::vector<std::vector<double>> footprints;
};

Outcome outcome_of(const Sight& sight, const Truth& truth, size_t view);

/// Over the pixels of all views; `views` are their outcomes one by one.
Outcome outcome_of_all(const Sight& sight, const Truth& truth, const std::vector<Outcome>& views);

/// What changed from one sight to another, all views together.
Share share_of(const std::string& source, const Sight& from, const Sight& to, const Truth& truth);

} // namespace tidemark::lab
