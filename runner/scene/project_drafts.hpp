// From the passes of a project to drafts: kind, name and channels, their texts still empty.
#pragma once

#include "base/result.hpp"
#include "scene/builder.hpp"
#include "scene/project_inputs.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::scene {

/// What a tab of that kind becomes: Common is none, and counts as Image.
PassKind kind_of(PassName::Kind kind);

struct ProjectDrafts {
    std::vector<Draft> drafts;
    std::vector<size_t> order; ///< of drawing
    std::vector<std::optional<size_t>>
        of_pass; ///< the draft of each of the project's passes; none for Common

    /// Where the text of a pass goes: into its draft, or behind what Common there is.
    text::MappedText& text_of(size_t pass, Scene& scene) {
        return of_pass[pass] ? drafts[*of_pass[pass]].pass.text : scene.common;
    }
};

/// Needs one Image pass; of several passes of a kind that ShaderToy has once, the last one counts and a
/// warning says so. Adds the warnings of the project and of its inputs to the scene's.
Result<ProjectDrafts> draft_project(Scene& scene, InputReader::Context context);

/// A text as the rest of the program takes it: plain line ends, and a blank for each NUL.
std::string plain_text(std::string text);

} // namespace tidemark::scene
