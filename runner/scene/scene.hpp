// What to draw, as values: the passes of a scene, what their channels read, and its knobs.
#pragma once

#include "base/result.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"
#include "text/mapped_text.hpp"

#include <filesystem>
#include <string>
#include <string_view>
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
    bool moves_view = false; ///< says `#iFirstPersonControls`: iViewMatrix follows the person
    std::vector<std::filesystem::path> files; ///< all files the scene read or will read, pictures included
    std::vector<Diagnostic> warnings;         ///< what was replaced by a stand-in, and why

    std::string name() const;
    const Pass* find(PassKind kind) const; ///< the last pass of that kind
    size_t image_index() const;            ///< of the Image pass (or what became of it); every scene has one
    const Pass& image() const { return passes[image_index()]; }
};

TextureKind texture_kind(const Scene& scene, const ChannelInput& input);

struct LoadOptions {
    std::filesystem::path media; ///< --media: where ShaderToy's media files are looked up by name
    bool allow_outside = false;  ///< --allow-outside: files may lie outside the scene's folder
};

/// Reads a scene: a bare `.glsl` or `.frag`, a scene folder, or a ShaderToy `.json`. Fails (ErrorCode::load)
/// with file and line. Pictures and other media are named, not opened.
Result<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// Carries out `--channel [PASS:]N=WHAT`: a picture file, `noise`, `none`; sampled as ShaderToy's textures
/// are.
Result<void> override_channel(Scene& scene, std::string_view setting);

/// Carries out `--set NAME=VALUE`. A value outside of the knob's range is taken, with a warning.
Result<void> override_knob(Scene& scene, std::string_view setting);

/// NAME and VALUE of `NAME=VALUE`; the error names the option that wants this form.
Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option);

} // namespace tidemark::scene
