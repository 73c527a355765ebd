// Reports on devices by `inspect` and `compare`. `inspect --devices`: lists devices that can have an OpenGL
// context; with --self-test checks each of them.
#pragma once

#include "base/error.hpp"
#include "host/devices.hpp"
#include "host/requests.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::cli {

/// Returns the exit code; with `self_test`, that of a failed check if a device fails one. `only`: the device
/// to list, "auto" for all. Mesa's drivers that draw on the CPU are tested only by their name.
Result<int> inspect_devices(const std::string& only, bool self_test, bool as_json);

// `tidemark inspect --with`: measures what leaving a part out saves, by putting it back.

struct SavingsOptions {
    host::SceneRequest scene;
    std::string size = "640x360";
    std::string pass;
    host::DeviceChoice device{};
    std::vector<std::string> things; ///< "all": each one separately, then all together
    double budget = 20;              ///< seconds
    bool json = false;
};

/// Returns the names that `things` may contain.
std::vector<std::string> things_left_out();

/// Prints a table or one JSON object. Returns exit code 1 if putting a part back changed a pixel, otherwise 5
/// if the budget was too short.
Result<int> inspect_savings(const SavingsOptions& options);

// `compare --devices A,B SCENE…`: draws scenes on two devices and says why they differ.

struct DevicesRequest {
    std::array<std::string, 2> devices{};
    std::vector<std::filesystem::path> scenes{};
    host::SceneRequest scene{}; ///< without its path
    host::FrameSequence sequence{};
    std::filesystem::path output{}; ///< folder of the page; empty: none
    bool json = false;
};

/// Returns exit code 1 if a difference is unexplained, or if a device does not draw a scene.
Result<int> compare_on_devices(const DevicesRequest& request);

} // namespace tidemark::cli
