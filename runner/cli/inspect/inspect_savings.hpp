// `tidemark inspect --with`: measures what leaving a part out saves, by putting it back.
#pragma once

#include "cli/requests.hpp"
#include "platform/device_choice.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

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
