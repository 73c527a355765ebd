// Parts of the overlay's model that depend on the scene.
#pragma once

#include "cli/moment.hpp"
#include "live/inputs/controller_map.hpp"
#include "live/model.hpp"

namespace tidemark::cli {

std::vector<live::KnobField> knob_fields(const scene::Scene& scene,
                                         const std::vector<scene::Setting>& turned);

/// Adds the MIDI binding of each component to the fields.
void add_controllers(std::vector<live::KnobField>& fields, const live::ControllerMap& map);

/// Returns the numeric definitions in the scene's texts, with the overrides of `request`.
std::vector<live::DefinitionField> definition_fields(const scene::Scene& scene, const SceneRequest& request);

/// Returns labels such as `2.500 s, height = 2`.
std::vector<std::string> view_labels(const std::vector<Moment>& views);

} // namespace tidemark::cli
