// Values that options or people hold against the file: what the file says of each, and the words for whoever
// edits it there. A `--define` stays; a `--set` is over as soon as the file has another default. Changes no
// scene.
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

/// The request without each `--set` that is over: the file had another default `before`.
SceneRequest without_edited(SceneRequest request, const std::vector<HeldValue>& before,
                            const std::vector<HeldValue>& now);

/// A line for each value that the file had another idea of before.
std::vector<std::string> edits_of_held(const std::vector<HeldValue>& before,
                                       const std::vector<HeldValue>& now);

/// A line for each knob with another default now that was turned by hand, and stays so.
std::vector<std::string> edits_of_turned(const std::vector<scene::Knob>& before,
                                         const std::vector<scene::Knob>& now,
                                         const std::vector<scene::Setting>& turned);

} // namespace tidemark::cli
