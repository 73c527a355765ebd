// Directives of the VS Code extension's grammar in a scene's text: `#iChannelN`, `#iUniform`, `#iKeyboard`;
// and `#iSize`, which is our own.
#pragma once

#include "base/result.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "scene/stated_size.hpp"
#include "text/mapped_text.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::scene {

struct Directives {
    Channels channels; ///< those that no directive names keep their defaults
    /// What stands between the quotes of `#iChannelN "…"`, `file://` left out; empty where nothing does. The
    /// name of a pass is for pass_loader.hpp: its channel is Unbound.
    std::array<std::string, k_channel_count> sources;
    std::vector<Knob> knobs;
    std::vector<StatedSize> sizes;    ///< in order, from included files too
    bool keyboard_helpers = false;    ///< `#iKeyboard`
    bool moves_view = false;          ///< `#iFirstPersonControls`
    std::vector<Diagnostic> warnings; ///< what we read and leave out
};

/// Whether a directive under an `#if` counts, as it does for the extension. In a text that was written for
/// ShaderToy it is for another host, and is left to the preprocessor.
enum class Conditional { read, leave };

/// Reads all directives and blanks them out of `text`, so that the driver does not see them and no line
/// moves. File names are relative to the file that holds the directive. A cubemap's file may have a `*` or
/// `{}` in the place of its six suffixes.
Result<Directives> take_directives(text::MappedText& text, Conditional conditional = Conditional::read);

} // namespace tidemark::scene
