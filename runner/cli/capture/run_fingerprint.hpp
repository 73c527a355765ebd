// The fingerprint that all frames of a capture share.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

namespace tidemark::cli {

/// Reads the files that the scene reads.
Fingerprint fingerprint_of_run(const CapturePlan& plan, const gl::Capabilities& driver);

} // namespace tidemark::cli
