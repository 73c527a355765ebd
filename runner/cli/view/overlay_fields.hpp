// Parts of the overlay's model that a scene decides.
#pragma once

#include "cli/moment.hpp"
#include "live/inputs/controller_map.hpp"
#include "live/model.hpp"

namespace tidemark::cli {

std::vector<live::KnobField> knob_fields(const scene::Scene& scene,
                                         const std::vector<scene::Setting>& turned);

/// For each of the fields, where a MIDI device turns knobs.
void add_controllers(std::vector<live::KnobField>& fields, const live::ControllerMap& map);

/// The numbers that the scene's texts define, as they are after `request`.
std::vector<live::DefinitionField> definition_fields(const scene::Scene& scene, const SceneRequest& request);

/// `2.500 s, height = 2`.
std::vector<std::string> view_labels(const std::vector<Moment>& views);

} // namespace tidemark::cli
