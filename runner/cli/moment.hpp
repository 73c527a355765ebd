// A moment of a scene: all that a picture of it was drawn from, but for the files. In a picture's metadata,
// in a list of kept views or on the command line, it is drawn again.
#pragma once

#include "cli/json_dump.hpp"
#include "cli/requests.hpp"

#include <string>

namespace tidemark::cli {

struct Moment {
    SceneRequest scene;
    FrameSequence sequence; ///< one frame, which is `sequence.state`; the recording by its name alone

    int frame() const { return sequence.state.frame; }
};

/// That of a frame of a sequence. `state` is all that the frame sees.
Moment moment_of(SceneRequest scene, const FrameSequence& sequence, render::FrameState state);

/// --allow-outside is left out: it is not for a file to allow anything.
Json to_json(const Moment& moment);
/// Of what to_json made. Nothing where it is another's, or holds what no option could say.
std::optional<Moment> moment_of(const Json& json);

/// `tidemark capture …`, as far as options can say what people did.
std::string capture_command(const Moment& moment);

/// Settings `NAME=VALUE`: those of `older` that `newer` does not name, then `newer`.
std::vector<std::string> merged(std::vector<std::string> older, const std::vector<std::string>& newer);

/// Knobs that stand over what the scene has go where `sets` name them.
void erase_named(const std::vector<std::string>& sets, std::vector<scene::Setting>& knobs);

} // namespace tidemark::cli
