// `inspect --devices`: lists devices that can have an OpenGL context; with --self-test checks each of them.
#pragma once

#include "base/error.hpp"
#include "host/devices.hpp"
#include "host/requests.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Returns the exit code; with `self_test`, that of a failed check if a device fails one.
Result<int> inspect_devices(bool self_test, bool as_json);

// `tidemark inspect --with`: measures what leaving a part out saves, by putting it back.

struct SavingsOptions {
    SceneRequest scene;
    std::string size = "640x360";
    std::string pass;
    platform::DeviceChoice device{};
    std::vector<std::string> things; ///< "all": each one separately, then all together
    double budget = 20;              ///< seconds
    bool json = false;
};

/// Returns the names that `things` may contain.
std::vector<std::string> things_left_out();

/// Prints a table or one JSON object. Returns exit code 1 if putting a part back changed a pixel, otherwise 5
/// if the budget was too short.
Result<int> inspect_savings(const SavingsOptions& options);

} // namespace tidemark::cli
