// Checks whether all numbers of a scene are finite in given situations. Counts by bits on the CPU.
#pragma once

#include "lab/check/probe.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// Returns the fault of the first pass that has a NaN or an infinity, with the number of such pixels and a
/// picture that marks them; nothing if all passes are finite.
std::optional<Answer> not_finite(const ProbeBench& bench, const FrameState& state,
                                 const std::vector<PassPicture>& passes);

/// Checks every situation; the answer reports the first that fails, and how many do.
Result<Answer> look(ProbeBench& bench, const std::vector<FrameState>& states);

/// Like `look`, but not applicable if the scene is not finite in the plain state already.
Result<Answer> look_anew(ProbeBench& bench, const std::vector<FrameState>& states);

} // namespace tidemark::lab
