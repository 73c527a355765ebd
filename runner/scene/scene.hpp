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

/// One unit of drawing (ShaderToy's render pass).
struct Pass {
    std::string name;      ///< "Image"
    text::MappedText text; ///< includes pasted, directives blanked out, every line where its author put it
    Channels channels;
};

struct Scene {
    std::filesystem::path file; ///< as it was named on the command line
    std::vector<Pass> passes;
    std::vector<Knob> knobs;
    std::vector<std::filesystem::path> files; ///< all files the scene read or will read, pictures included

    std::string name() const { return file.stem().string(); }
    const Pass& image() const { return passes.back(); }
};

/// Reads a bare `.glsl`: a text with `mainImage`, includes and directives. Fails (ErrorCode::load) with file
/// and line. Pictures are named, not opened.
Result<Scene> load_scene(const std::filesystem::path& path);

/// Carries out `--channel N=WHAT`: a picture file, `noise` or `none`, sampled as ShaderToy samples textures.
Result<void> override_channel(Scene& scene, std::string_view setting);

/// Carries out `--set NAME=VALUE`.
Result<void> override_knob(Scene& scene, std::string_view setting);

/// NAME and VALUE of `NAME=VALUE`; the error names the option that wants this form.
Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option);

} // namespace tidemark::scene
