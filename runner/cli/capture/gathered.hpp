// Whether the frames that shards made are one sequence: all there, whole, and with one fingerprint.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/fingerprint.hpp"

#include <map>
#include <string>
#include <vector>

namespace tidemark::cli {

struct Gathered {
    std::vector<std::string> wrong;          ///< for people, a line each
    std::map<std::string, size_t> devices{}; ///< that drew frames, and how many
    bool drawn_here = true;                  ///< by a device like this machine's
};

/// Of the whole plan, not of a shard. `run`: what this machine would draw with.
Gathered gathered(const CapturePlan& plan, const Fingerprint& run, int shards);

} // namespace tidemark::cli
