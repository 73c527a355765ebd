// The frames of a capture that are on disk already, from a run that was cut short: `--resume` is the plan
// without them. A frame is kept where its file is whole and its fingerprint is the one it would be drawn
// with.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

struct KeptFrames {
    std::vector<int> frames;       ///< in the order of the plan
    std::vector<std::string> said; ///< for people: what is drawn again, and why
};

/// Takes them out of the plan, and marks the segments of a video. Changes no file.
KeptFrames leave_out_kept(CapturePlan& plan, const Fingerprint& run);

/// The files of a frame: a picture, or the six faces of a cube.
std::vector<std::filesystem::path> files_of(const OutputName& output, int frame);

/// Why the picture in that file is not the one with this fingerprint; empty: it is.
std::string why_not_kept(const std::filesystem::path& file, const Fingerprint& wanted);

} // namespace tidemark::cli
