// What a person wants to know of a study, in sentences. Pure; no sentence where the noise allows none.
#pragma once

#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The time of `slow` over that of `fast`, by rounds that were measured together; nothing without times.
struct Speedup {
    double ratio = 1;
    Interval confidence{}; ///< 95 %

    bool certain() const { return !confidence.contains(1.0); }
};
std::optional<Speedup> speedup(const WorkPrecision& slow, const WorkPrecision& fast);

/// The cheapest point that is sure to keep the study's promise, the truth's own error taken against it; null:
/// none is. Idle points are in no verdict.
const WorkPrecision* cheapest_good(const WorkPrecisionSet& set);

/// The cheapest point whose error is at most that of the scene as it is; null: nothing was timed. Hollow
/// points cannot be told apart and are left out.
const WorkPrecision* cheapest_as_exact(const WorkPrecisionSet& set);

/// "cheapest setting with wrong <= 0.05 % and PSNR >= 50 dB: …", "at equal error 2.3 x [2.1, 2.5] faster than
/// the scene's defaults: …", and what the reader must know of their worth.
std::vector<std::string> sentences(const WorkPrecisionSet& set);

/// "held fixed, in the truth too: EPS = 0.001": what the figures say nothing of; empty: nothing is.
std::string held_sentence(const WorkPrecisionSet& set);

/// `4.21 ms [4.1, 4.3]`: a frame's time, with its interval where there were rounds enough for one.
std::string cost_of(const WorkPrecision& point);

/// `0.0123`: three digits.
std::string figure(double value);

} // namespace tidemark::lab
