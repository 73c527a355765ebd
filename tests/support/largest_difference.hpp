// How far two pictures of a test are apart, in one number.
#pragma once

#include "media/comparison.hpp"

#include <limits>

namespace tidemark {

/// Returns the largest difference of two samples; NaN, which passes no comparison, if the pictures differ in
/// size or if only one of two samples is finite.
inline double largest_difference(const image::Image& left, const image::Image& right) {
    const auto difference = image::compare(left, right);
    return difference && difference->one_non_finite == 0 ? difference->largest
                                                         : std::numeric_limits<double>::quiet_NaN();
}

} // namespace tidemark
