// `tidemark inspect --with`: what leaving a thing out saves, measured by putting it back.
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
    std::vector<std::string> things; ///< "all": every one by itself, then all together
    double budget = 20;              ///< seconds
    bool json = false;
};

/// The words that `things` may hold.
std::vector<std::string> things_left_out();

/// A table, or one JSON object. Exit code 1 where putting a thing back changed a pixel; else 5 where the
/// budget did not suffice.
Result<int> inspect_savings(const SavingsOptions& options);

} // namespace tidemark::cli
