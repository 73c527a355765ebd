// Compiles the programs that draw a plan, with tiles for large frames, and the faster of two programs if a
// trial is planned.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/interrupt.hpp"
#include "cli/trial.hpp"

namespace tidemark::cli {

/// A context must be current. The plan's `timeout` applies.
Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt);

} // namespace tidemark::cli
