// Whether all numbers of a scene are finite in given situations, counted by bits on the CPU.
#pragma once

#include "lab/check/probe.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// The fault that the passes of a frame show: the first pass with a NaN or an infinity, its pixels counted
/// and marked.
std::optional<Answer> not_finite(const ProbeBench& bench, const FrameState& state,
                                 const std::vector<PassPicture>& passes);

/// Asks the same of every situation; the first bad one is reported.
Result<Answer> look(ProbeBench& bench, const std::vector<FrameState>& states);

/// As `look`, of situations that are new only where the plain one is clean.
Result<Answer> look_anew(ProbeBench& bench, const std::vector<FrameState>& states);

} // namespace tidemark::lab
