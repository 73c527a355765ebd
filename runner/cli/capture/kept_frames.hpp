// Finds frames of an interrupted capture that are already on disk: `--resume` draws the plan without them. A
// frame is kept if its file is complete and has the fingerprint that it would be drawn with.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

struct KeptFrames {
    std::vector<int> frames;       ///< in the order of the plan
    std::vector<std::string> said; ///< messages: the frames that are drawn again, and why
};

/// Removes kept frames from the plan, and marks the kept segments of a video. Changes no file.
KeptFrames leave_out_kept(CapturePlan& plan, const Fingerprint& run);

/// Returns the files of a frame: one picture, or the six faces of a cube.
std::vector<std::filesystem::path> files_of(const OutputName& output, int frame);

/// Returns why the picture in the file does not have this fingerprint; empty if it does.
std::string why_not_kept(const std::filesystem::path& file, const Fingerprint& wanted);

} // namespace tidemark::cli
