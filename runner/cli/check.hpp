// `tidemark check SCENE`: runs the probes of lab/probes.hpp and reports their findings.
#pragma once

#include "base/error.hpp"
#include "host/devices.hpp"
#include "host/requests.hpp"
#include "lab/probe_inputs.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

class Interrupt;

struct ProbesRequest {
    SceneRequest scene;
    std::vector<std::string> probes; ///< --probe; empty: all
    std::string output;              ///< folder for index.html and pictures of failures; empty: none
    platform::DeviceChoice device{};
    double budget = 60; ///< seconds after which no further probe is started
    bool json = false;
    bool all = false; ///< also print notes, each probe's sentence, and why probes do not apply
};

/// Reads the promises from the check.json of a scene.
Result<lab::Promises> promises_of(const SceneRequest& request, const scene::Scene& scene);

/// Prints a description of each probe.
Result<int> list_probes();

/// Returns exit code 1 if a probe fails. After an interrupt it prints what was found so far, and returns
/// Interrupt::k_exit_code.
Result<int> check_probes(const ProbesRequest& request, Interrupt& interrupt);

// `tidemark check --fix SCENE`: fixes for findings of the probes (lab/fix), as differences of the scene's
// files.

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

// `tidemark check --portable`: finds code that does not compile on ShaderToy's own site.

/// Prints one line for each place that the site's compiler refuses; returns exit code 1 if there is one.
Result<int> check_portable(const SceneRequest& request, const platform::DeviceChoice& device, bool as_json);

// `tidemark check --trace`: names the statement where a NaN or an infinity originates.

struct TraceOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string pixel; ///< `x,y`; empty: the first pixel that is not finite
    platform::DeviceChoice device{};
    double timeout = 60;
    bool hidden = false;
    bool json = false;
};

/// Returns exit code 1 if something not finite was found.
Result<int> check_trace(const TraceOptions& options);

} // namespace tidemark::cli
