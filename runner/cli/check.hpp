// `tidemark check SCENE`: runs the probes of lab/probes.hpp and reports their findings.
#pragma once

#include "base/error.hpp"
#include "cli/changed_files.hpp"
#include "host/devices.hpp"
#include "host/forked.hpp"
#include "host/requests.hpp"
#include "lab/probe_inputs.hpp"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <vector>

namespace tidemark::host {
class Interrupt;
}

namespace tidemark::lab {
struct ShownError;
}

namespace tidemark::cli {

struct ProbesRequest {
    host::SceneRequest scene;
    std::vector<std::string> probes; ///< --probe; empty: all
    std::string output;              ///< folder for index.html and pictures of failures; empty: none
    host::DeviceChoice device{};
    double budget = 60; ///< seconds after which no further probe is started
    bool json = false;
    bool all = false; ///< also print notes, each probe's sentence, and why probes do not apply
};

/// Reads the promises from the check.json of a scene.
Result<lab::Promises> promises_of(const host::SceneRequest& request, const scene::Scene& scene);

/// Prints a description of each probe.
Result<int> list_probes();

/// Returns exit code 1 if a probe fails. After an interrupt it prints what was found so far, and returns
/// Interrupt::k_exit_code.
Result<int> check_probes(const ProbesRequest& request, host::Interrupt& interrupt);

// `tidemark check --fix SCENE`: fixes for findings of the probes (lab/fix), as differences of the scene's
// files.

struct FixOptions {
    host::SceneRequest scene;
    host::DeviceChoice device;
    double budget = 60; ///< seconds for everything
    bool write = false; ///< write each fix into the files as soon as it is confirmed
    bool json = false;
    bool hashes = false;  ///< also fix hashes of large sines
    std::string output{}; ///< folder for a page; empty: none
};

/// Returns exit code 1 if there is a finding without a fix.
Result<int> check_fix(FixOptions options);

/// Finds and measures the fixes of a scene that was loaded with the options' texts. Sends a line of JSON for
/// each: `offer`, its `text` and `files`, or for each finding without one: `remains`. `measured`: see
/// lab::Mending. A context must be current; it belongs into a process of its own, since a driver may hang or
/// crash.
Result<void> send_fixes(const FixOptions& options, const scene::Scene& scene, const lab::Promises& promises,
                        const host::Tell& tell,
                        std::function<void(const Result<lab::ShownError>&)> measured = {});
/// Returns the files of an offer's line before and after the fix.
std::vector<ChangedFile> files_of_offer(const nlohmann::ordered_json& line);

// `tidemark check --portable`: finds code that does not compile on ShaderToy's own site.

/// Prints one line for each place that the site's compiler refuses; returns exit code 1 if there is one.
Result<int> check_portable(const host::SceneRequest& request, const host::DeviceChoice& device, bool as_json);

// `tidemark check --trace`: names the statement where a NaN or an infinity originates.

struct TraceOptions {
    host::SceneRequest scene;
    host::FrameOptions frames;
    std::string pixel; ///< `x,y`; empty: the first pixel that is not finite
    host::DeviceChoice device{};
    double timeout = 60;
    bool hidden = false;
    bool json = false;
};

/// Returns exit code 1 if something not finite was found.
Result<int> check_trace(const TraceOptions& options);

} // namespace tidemark::cli
