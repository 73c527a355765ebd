// `tidemark check --fix SCENE`: cures of what the probes find (lab/fix), as differences of the scene's files.
#pragma once

#include "base/result.hpp"
#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

struct FixOptions {
    SceneRequest scene;
    platform::DeviceChoice device;
    double budget = 60; ///< seconds for all of it
    bool write = false; ///< into the files, each as soon as it is found better
    bool json = false;
    bool hashes = false;  ///< of large sines, too
    std::string output{}; ///< folder for a page; empty: none
};

/// Exit code 1 where something was found that no cure is offered for.
Result<int> check_fix(FixOptions options);

} // namespace tidemark::cli
