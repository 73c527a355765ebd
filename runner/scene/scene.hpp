// A scene as values: its passes, the inputs of their channels, and its knobs.
#pragma once

#include "base/extent.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "text/mapped_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::scene {

enum class PassKind {
    buffer,
    cubemap,
    image,
    sound,
    hit, ///< Image, instrumented to output hits instead of colours: glsl/hit.hpp
};

/// One unit of drawing (ShaderToy's render pass).
struct Pass {
    PassKind kind = PassKind::image;
    std::string name;      ///< "Image", "Buffer A": unique in its scene
    text::MappedText text; ///< includes pasted, directives blanked out, line numbers unchanged
    Channels channels;
    bool keyboard_helpers = false; ///< has `#iKeyboard`: isKeyDown(Key_A) and the like must be declared
    bool bare_file = false; ///< not part of a project: SHADER_TOY is defined, as in the VS Code extension
};

struct Scene {
    std::filesystem::path file; ///< as named on the command line
    text::MappedText common;    ///< precedes the text of every pass
    std::vector<Pass> passes;   ///< in drawing order; a sound pass, if any, is last
    std::vector<Knob> knobs;
    std::optional<Extent> size{}; ///< size that the author states with `#iSize`
    bool moves_view = false;      ///< has `#iFirstPersonControls`: iViewMatrix follows the user's mouse
    std::vector<std::filesystem::path> files; ///< all files that the scene reads, pictures included
    std::vector<Diagnostic> warnings;         ///< such as inputs replaced by a stand-in, with the reason

    std::string name() const;
    const Pass* find(PassKind kind) const; ///< the last pass of that kind
    /// index of the Image pass, or of the hit pass made from it; every scene has one
    size_t image_index() const;
    const Pass& image() const { return passes[image_index()]; }
};

TextureKind texture_kind(const Scene& scene, const ChannelInput& input);

} // namespace tidemark::scene
