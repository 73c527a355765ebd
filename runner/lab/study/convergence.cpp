#include "lab/study/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

/// Returns 1 / (1 - r): the sum of all changes from this one on, divided by this one.
double sum_over_last(double before, double last) {
    return 1 / (1 - last / before);
}

} // namespace

Remainder remainder_of(const std::vector<double>& changes, double rounding) {
    if (changes.empty())
        return {{}, "no knob of the study is a number that could go on", false};
    const double last = changes.back();
    if (std::isnan(last))
        return {{}, "what the last step changed is no number", false};
    if (last <= rounding)
        return {rounding, fmt::format("the last step changed {:.2g}, which is rounding", last), true};
    if (changes.size() < 2)
        return {{}, fmt::format("of one change, {:.2g}, nobody knows what comes after it", last), false};
    const double before = changes[changes.size() - 2];
    const double ratio = last / before;
    if (!(ratio < 1))
        return {
            {},
            fmt::format("it does not converge: the last two steps changed {:.2g} and {:.2g}", before, last),
            false};
    const double sum = sum_over_last(before, last);
    const double first = changes.size() > 2 ? changes[changes.size() - 3] : 0;
    // These sums grow by this amount from step to step: 0 for a power of the setting, 1/s for its logarithm
    // to the power of -s.
    const double growth = before < first ? std::max(0.0, sum - sum_over_last(first, before)) : 0.0;
    if (!(growth < 0.9))
        return {{},
                fmt::format("it does not converge: the changes shrink by ever less ({:.2g}, {:.2g}, {:.2g})",
                            first, before, last),
                false};
    const double factor = sum / (1 - growth) - 1;
    return {std::max(rounding, last * factor),
            fmt::format("the last change {:.2g}, {:.2g} of the one before, goes on to {:.2g}", last, ratio,
                        last * factor),
            false};
}

} // namespace tidemark::lab
