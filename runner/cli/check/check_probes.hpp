// `tidemark check SCENE`: runs the probes of lab/check/probe.hpp and reports their findings.
#pragma once

#include "base/result.hpp"
#include "cli/requests.hpp"
#include "lab/check/promises.hpp"
#include "platform/device_choice.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

struct ProbesRequest {
    SceneRequest scene;
    std::vector<std::string> probes; ///< --probe; empty: all
    std::string output;              ///< folder for index.html and pictures of failures; empty: none
    platform::DeviceChoice device{};
    double budget = 60; ///< seconds after which no further probe is started
    bool json = false;
};

/// Reads the promises from the check.json of a scene.
Result<lab::Promises> promises_of(const SceneRequest& request, const scene::Scene& scene);

/// Prints a description of each probe.
Result<int> list_probes();

/// Returns exit code 1 if a probe fails.
Result<int> check_probes(const ProbesRequest& request);

} // namespace tidemark::cli
