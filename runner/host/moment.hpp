// A moment of a scene: everything that a picture of it was drawn from, except the files. It is stored in a
// picture's metadata or in a list of saved views, or given on the command line, and can be drawn again.
#pragma once

#include "host/json.hpp"
#include "host/requests.hpp"
#include "scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::host {

struct Moment {
    SceneRequest scene;
    FrameSequence sequence; ///< one frame, `sequence.state`; the recording only as its file name

    int frame() const { return sequence.state.frame; }
};

/// Returns the moment of one frame of a sequence. `state` is all that the frame depends on.
Moment moment_of(SceneRequest scene, const FrameSequence& sequence, render::FrameState state);

/// Leaves --allow-outside out: a file must not grant permissions.
Json to_json(const Moment& moment);
/// Reads the output of to_json. Fails if the JSON has another form, or holds values that no option accepts;
/// the error for a value of a knob contains its name.
Result<Moment> moment_of(const Json& json);

/// Returns `tidemark capture …` with all state that options can express.
std::string capture_command(const Moment& moment);

/// Returns the settings `NAME=VALUE` of `older` that `newer` does not name, followed by `newer`.
std::vector<std::string> merged(std::vector<std::string> older, const std::vector<std::string>& newer);

/// Removes the knob values that `sets` names.
void erase_named(const std::vector<std::string>& sets, std::vector<scene::KnobSetting>& knobs);

// The metadata of a picture's file: the facts from which it can be drawn again.

/// Metadata key of the Fingerprint.
inline constexpr const char* k_fingerprint = "Fingerprint";
/// Metadata key of the Moment, as JSON.
inline constexpr const char* k_moment = "Moment";

/// Returns the names and values of a picture's metadata (image::PictureFormat): the scene with its knobs, the
/// frame with its mouse and camera in the options' format, the program, and the moment that `--like` reads.
std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene, const Moment& moment);

} // namespace tidemark::host
