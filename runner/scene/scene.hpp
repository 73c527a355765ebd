// What to draw, as values: the passes of a scene, what their channels read, and its knobs.
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
    hit, ///< Image, asked for what it hit instead of a colour: glsl/hit.hpp
};

/// One unit of drawing (ShaderToy's render pass).
struct Pass {
    PassKind kind = PassKind::image;
    std::string name;      ///< "Image", "Buffer A": unique in its scene
    text::MappedText text; ///< includes pasted, directives blanked out, every line where its author put it
    Channels channels;
    bool keyboard_helpers = false; ///< says `#iKeyboard`: wants isKeyDown(Key_A) and the like declared
    bool bare_file = false;        ///< of no project: finds SHADER_TOY defined, as in the VS Code extension
};

struct Scene {
    std::filesystem::path file; ///< as it was named on the command line
    text::MappedText common;    ///< stands in front of every pass
    std::vector<Pass> passes;   ///< in the order of drawing; a sound pass, if any, last
    std::vector<Knob> knobs;
    std::optional<Extent> size{}; ///< that its author wants to see it in, by `#iSize`
    bool moves_view = false;      ///< says `#iFirstPersonControls`: iViewMatrix follows the person
    std::vector<std::filesystem::path> files; ///< all files the scene read or will read, pictures included
    std::vector<Diagnostic> warnings;         ///< what was replaced by a stand-in, and why

    std::string name() const;
    const Pass* find(PassKind kind) const; ///< the last pass of that kind
    size_t image_index() const;            ///< of the Image pass (or what became of it); every scene has one
    const Pass& image() const { return passes[image_index()]; }
};

TextureKind texture_kind(const Scene& scene, const ChannelInput& input);

} // namespace tidemark::scene
