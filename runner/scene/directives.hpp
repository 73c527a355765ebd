// Reads the VS Code extension's directives in a scene's text, `#iChannelN`, `#iUniform`, `#iKeyboard` and so
// on, and Tidemark's own `#iSize`.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"

#include <array>
#include <string>
#include <vector>

namespace tidemark::scene {

struct Directives {
    Channels channels; ///< a channel that no directive names keeps its default
    /// The quoted text of `#iChannelN "…"` without `file://`; empty without such a directive. If it names a
    /// pass, pass_loader.hpp resolves it and the channel here is Unbound.
    std::array<std::string, k_channel_count> sources;
    std::vector<Knob> knobs;
    std::vector<StatedSize> sizes;    ///< in order, including those of included files
    bool keyboard_helpers = false;    ///< `#iKeyboard`
    bool moves_view = false;          ///< `#iFirstPersonControls`
    std::vector<Diagnostic> warnings; ///< directives that are recognised and ignored
};

/// Whether a directive under an `#if` is read, as the extension does. In a text written for ShaderToy such a
/// directive is meant for another host and is left to the preprocessor.
enum class Conditional { read, leave };

/// Reads all directives and blanks them out of `text`, so that the driver does not see them and line numbers
/// stay. File names are relative to the file with the directive. A cubemap's file name may have `*` or `{}`
/// in place of its six suffixes.
Result<Directives> take_directives(text::MappedText& text, Conditional conditional = Conditional::read);

} // namespace tidemark::scene
