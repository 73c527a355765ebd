// `tidemark check SCENE`: asks the probes of lab/check/probe.hpp and reports what they found.
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
    double budget = 60; ///< seconds after which no other probe is begun
    bool json = false;
};

/// What the file beside a scene promises of it.
Result<lab::Promises> promises_of(const SceneRequest& request, const scene::Scene& scene);

/// What each probe looks at.
Result<int> list_probes();

/// Exit code 1 when a probe fails.
Result<int> check_probes(const ProbesRequest& request);

} // namespace tidemark::cli
