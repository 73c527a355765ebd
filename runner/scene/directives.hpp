// Directives of the VS Code extension's grammar in a scene's text: `#iChannelN`, `#iUniform`.
#pragma once

#include "base/result.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "text/mapped_text.hpp"

#include <vector>

namespace tidemark::scene {

struct Directives {
    Channels channels; ///< those that no directive names keep their defaults
    std::vector<Knob> knobs;
};

/// Reads all directives and blanks them out of `text`, so that the driver does not see them and no line
/// moves. File names are relative to the file that holds the directive.
Result<Directives> take_directives(text::MappedText& text);

} // namespace tidemark::scene
