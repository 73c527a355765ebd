// The results of a study, in sentences. Pure; conclusions that the noise does not allow are left out.
#pragma once

#include "lab/study/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The time of `slow` divided by that of `fast`, from rounds that were measured together.
struct Speedup {
    double ratio = 1;
    Interval confidence{}; ///< 95 %

    bool certain() const { return !confidence.contains(1.0); }
};
std::optional<Speedup> speedup(const WorkPrecision& slow, const WorkPrecision& fast);

/// Returns the cheapest point that certainly keeps the study's promise, even if the truth's own error counts
/// against it; nullptr if there is none. Idle points are excluded.
const WorkPrecision* cheapest_good(const WorkPrecisionSet& set);

/// Returns the cheapest point whose error is at most that of the unchanged scene; nullptr if nothing was
/// timed. Hollow points cannot be compared and are excluded.
const WorkPrecision* cheapest_as_exact(const WorkPrecisionSet& set);

/// For example "cheapest setting with wrong <= 0.05 % and PSNR >= 50 dB: …" or "at equal error 2.3 x [2.1,
/// 2.5] faster than the scene's defaults: …", and what limits their validity.
std::vector<std::string> sentences(const WorkPrecisionSet& set);

/// Lists the numbers that are held fixed, which the figures therefore do not cover; empty if there are none.
std::string held_sentence(const WorkPrecisionSet& set);

/// For example `4.21 ms [4.1, 4.3]`: a frame's time, with its interval if there were enough rounds.
std::string cost_of(const WorkPrecision& point);

/// Formats with three digits, for example `0.0123`.
std::string figure(double value);

} // namespace tidemark::lab
