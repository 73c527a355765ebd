// `tidemark check --fix SCENE`: fixes for findings of the probes (lab/fix), as differences of the scene's
// files.
#pragma once

#include "base/result.hpp"
#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

struct FixOptions {
    SceneRequest scene;
    platform::DeviceChoice device;
    double budget = 60; ///< seconds for everything
    bool write = false; ///< write each fix into the files as soon as it is confirmed
    bool json = false;
    bool hashes = false;  ///< also fix hashes of large sines
    std::string output{}; ///< folder for a page; empty: none
};

/// Returns exit code 1 if there is a finding without a fix.
Result<int> check_fix(FixOptions options);

} // namespace tidemark::cli
