// Checks whether the frames that shards made are one sequence: all present, complete, and with one
// fingerprint.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

#include <map>
#include <string>
#include <vector>

namespace tidemark::cli {

struct Gathered {
    std::vector<std::string> wrong;          ///< messages, one line each
    std::map<std::string, size_t> devices{}; ///< devices that drew frames, and their number of frames
    bool drawn_here = true;                  ///< by a device like this machine's
};

/// Checks the whole plan, not one shard. `run` is the fingerprint that this machine would draw with.
Gathered gathered(const CapturePlan& plan, const Fingerprint& run, int shards);

} // namespace tidemark::cli
