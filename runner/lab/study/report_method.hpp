// Describes as HTML how a study's figures were measured: truths, clock, machine, scene, observed orders,
// omissions.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Returns an empty text if no curve has enough points.
std::string orders(const WorkPrecisionSet& set);

std::string method(const WorkPrecisionSet& set);

/// Returns an empty text if nothing was left out.
std::string left_out(const WorkPrecisionSet& set);

} // namespace tidemark::lab
