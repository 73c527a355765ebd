// `--like PICTURE`: takes the moment from a picture's metadata for everything that the command line leaves
// open.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

namespace tidemark::cli {

/// Completes the options from the picture's metadata; without --like they are unchanged. Paths outside the
/// scene's folder are left out with a message, since a file must not cause others to be read. Fails if the
/// picture holds no moment, or if its scene does not exist.
Result<CaptureOptions> with_likeness(CaptureOptions options);

/// Prints a line if the picture was drawn from another text, with other inputs, or by another driver.
void say_what_is_unlike(const CapturePlan& plan, const Fingerprint& fingerprint);

} // namespace tidemark::cli
