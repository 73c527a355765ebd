// Reads what texts for other hosts (glslViewer, glslsandbox.com, Bonzomatic, ISF, Fragmentarium) declare:
// uniforms of their own, which become knobs, the picture of the last frame, and varyings.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

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

/// Blanks out declarations that `definitions` replaces. `is_taken` tells which channels and names the text's
/// directives use.
OtherHosts read_other_hosts(text::MappedText& text, const std::array<bool, k_channel_count>& taken_channels,
                            const std::vector<Knob>& declared);

} // namespace tidemark::scene
