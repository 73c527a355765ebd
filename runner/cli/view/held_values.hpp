// Values that `--set` and `--define` hold whatever the file says: what the file says of each, and the words
// for whoever edits it there and sees nothing change. Changes no scene.
#pragma once

#include "cli/requests.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

struct HeldValue {
    std::string_view option; ///< `--set`, `--define`
    std::string name;
    std::string value;   ///< as the option has it
    std::string in_file; ///< as the scene has it

    bool is_of(const HeldValue& other) const { return option == other.option && name == other.name; }
};

/// `scene` is as its files have it: no option has changed it yet. What it does not have is left out.
std::vector<HeldValue> held_values(const SceneRequest& request, const scene::Scene& scene);

/// A line for each value that the file had another idea of before.
std::vector<std::string> edited_in_vain(const std::vector<HeldValue>& before,
                                        const std::vector<HeldValue>& now);

} // namespace tidemark::cli
