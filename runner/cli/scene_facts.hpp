// Describes a scene from its files alone, as text and as JSON. No driver is used, so it does not say which
// channels a program reads or which passes are drawn.
#pragma once

#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::cli {

/// Returns the name of a channel's input: a pass, a file, or the input's type.
std::string describe(const scene::Scene& scene, const scene::Channel& channel);

/// Returns true if a frame may depend on the one before, judged by the files alone: the scene has a buffer or
/// a cubemap pass.
bool may_feed_back(const scene::Scene& scene);

nlohmann::ordered_json files_of(const scene::Scene& scene);
nlohmann::ordered_json knobs_of(const scene::Scene& scene);
/// Lists each knob with its type, value and range.
std::string knob_lines(const scene::Scene& scene);

/// Return the names that --define and --vary accept, with their values.
nlohmann::ordered_json definitions_of(const scene::Scene& scene);
std::string definition_lines(const scene::Scene& scene);

/// Return files, passes with the channels that have an assigned input, knobs and definitions.
nlohmann::ordered_json what_files_say(const scene::Scene& scene);
std::string lines_of_files(const scene::Scene& scene);

} // namespace tidemark::cli
