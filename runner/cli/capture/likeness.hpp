// `--like PICTURE`: the moment that a picture shows, from its metadata, for what the command line leaves
// open.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

namespace tidemark::cli {

/// The options as they are where no picture is named. Says what of the picture is not followed: a file is
/// not to have others read that lie outside of the scene's folder. Fails where it holds no moment, or where
/// no scene is there.
Result<CaptureOptions> with_likeness(CaptureOptions options);

/// A line where that picture was drawn from another text, other inputs, or by another driver.
void say_what_is_unlike(const CapturePlan& plan, const Fingerprint& fingerprint);

} // namespace tidemark::cli
