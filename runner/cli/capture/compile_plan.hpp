// The programs that draw a plan: its scene compiled, with tiles where frames are large, and the faster one
// of two where a trial is planned.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/interrupt.hpp"
#include "cli/trial.hpp"

namespace tidemark::cli {

/// A context must be current. The plan's `timeout` holds.
Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt);

} // namespace tidemark::cli
