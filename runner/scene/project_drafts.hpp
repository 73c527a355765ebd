// Turns the passes of a project into drafts: kind, name and channels, with texts still empty.
#pragma once

#include "base/result.hpp"
#include "scene/builder.hpp"
#include "scene/project_inputs.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::scene {

/// Returns the pass kind of a tab; Common, which is not a pass, counts as Image.
PassKind kind_of(PassName::Kind kind);

struct ProjectDrafts {
    std::vector<Draft> drafts;
    std::vector<size_t> order; ///< drawing order
    std::vector<std::optional<size_t>>
        of_pass; ///< index of the draft of each of the project's passes; none for Common

    /// Returns the text to which a pass's code is appended: its draft's, or the scene's Common.
    text::MappedText& text_of(size_t pass, Scene& scene) {
        return of_pass[pass] ? drafts[*of_pass[pass]].pass.text : scene.common;
    }
};

/// Makes the drafts. Fails without an Image pass; of several passes of a kind that ShaderToy has once, the
/// last one counts, with a warning. Adds the warnings of the project and its inputs to the scene's.
Result<ProjectDrafts> draft_project(Scene& scene, InputReader::Context context);

/// Normalises a text: plain line ends, and a blank for each NUL.
std::string plain_text(std::string text);

} // namespace tidemark::scene
