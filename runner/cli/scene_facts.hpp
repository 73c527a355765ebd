// What the files of a scene say, for people and for programs. No driver is asked: whether a program reads a
// channel, and whether a pass is drawn, is its business.
#pragma once

#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tidemark::cli {

/// What a channel reads, in a word or by its file.
std::string describe(const scene::Scene& scene, const scene::Channel& channel);

/// Whether a frame may depend on the one before it: the driver, which knows, is not asked.
bool may_feed_back(const scene::Scene& scene);

nlohmann::ordered_json files_of(const scene::Scene& scene);
nlohmann::ordered_json knobs_of(const scene::Scene& scene);
/// Each with its type, value and range.
std::string knob_lines(const scene::Scene& scene);

/// What --define and --vary can take.
nlohmann::ordered_json definitions_of(const scene::Scene& scene);
std::string definition_lines(const scene::Scene& scene);

/// Files, passes with the channels that somebody chose an input for, knobs, definitions.
nlohmann::ordered_json what_files_say(const scene::Scene& scene);
std::string lines_of_files(const scene::Scene& scene);

} // namespace tidemark::cli
