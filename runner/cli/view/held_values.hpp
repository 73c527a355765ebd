// User overrides of the file's defaults, and the messages for edits of an overridden value in the file. A
// `--define` stays; a `--set` ends as soon as the file has another default. Changes no scene.
#pragma once

#include "cli/requests.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::cli {

struct HeldValue {
    std::string_view option; ///< `--set`, `--define`
    std::string name;
    std::string value;   ///< as the option gives it
    std::string in_file; ///< as the file has it

    bool is_of(const HeldValue& other) const { return option == other.option && name == other.name; }
};

/// Returns the overrides in `request`. `scene` must be as its files have it, before options change it. Names
/// that the scene does not have are left out.
std::vector<HeldValue> held_values(const SceneRequest& request, const scene::Scene& scene);

/// Returns the request without each `--set` whose default in the file has changed since `before`.
SceneRequest without_edited(SceneRequest request, const std::vector<HeldValue>& before,
                            const std::vector<HeldValue>& now);

/// Returns a message for each overridden value that has changed in the file.
std::vector<std::string> edits_of_held(const std::vector<HeldValue>& before,
                                       const std::vector<HeldValue>& now);

/// Returns a message for each knob whose default has changed and that keeps the value set in the window.
std::vector<std::string> edits_of_turned(const std::vector<scene::Knob>& before,
                                         const std::vector<scene::Knob>& now,
                                         const std::vector<scene::Setting>& turned);

} // namespace tidemark::cli
