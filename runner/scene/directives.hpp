// Reads the VS Code extension's directives in a scene's text, `#iChannelN`, `#iUniform`, `#iKeyboard` and so
// on, and Tidemark's own `#iSize`.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"

#include <array>
#include <optional>
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

// Reads what texts for other hosts (glslViewer, glslsandbox.com, Bonzomatic, ISF, Fragmentarium) declare:
// uniforms of their own, which become knobs, the picture of the last frame, and varyings.

struct OtherHosts {
    std::vector<Knob> knobs; ///< numeric uniforms that neither the host nor a directive sets
    /// Generated lines that precede the text: `#define backbuffer iChannel9`.
    std::string definitions;
    /// The channel that reads the pass's own last frame, for a text that declares `sampler2D backbuffer`.
    std::optional<size_t> last_frame;
    /// The channels that read the passes of `#ifdef BUFFER_0`, `BUFFER_1` and so on, as in glslViewer. Empty
    /// for a text without such passes.
    std::vector<std::optional<size_t>> buffers;
    std::vector<Diagnostic> warnings; ///< declarations that nothing fills; the dialect of another host
};

/// Returns what to write for a file that another host brings along (`#include "DE-Raytracer.frag"`), as a
/// sentence without its full stop; empty for any other.
std::string_view advice_on_missing_include(std::string_view name);

/// Blanks out declarations that `definitions` replaces. `taken_channels` and `declared` are those that the
/// text's directives use already.
OtherHosts read_other_hosts(text::MappedText& text, const std::array<bool, k_channel_count>& taken_channels,
                            const std::vector<Knob>& declared);

} // namespace tidemark::scene
