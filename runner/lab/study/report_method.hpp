// How a study's figures came about, as HTML: truths, clock, machine, scene, observed orders, what was left
// out.
#pragma once

#include "lab/study/work_precision.hpp"

#include <string>

namespace tidemark::lab {

/// Empty: no curve has points enough.
std::string orders(const WorkPrecisionSet& set);

std::string method(const WorkPrecisionSet& set);

/// Empty: nothing was left out.
std::string left_out(const WorkPrecisionSet& set);

} // namespace tidemark::lab
