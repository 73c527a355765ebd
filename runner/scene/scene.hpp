// A scene as values, the size it states, and the changes that options make to it.
//
// The size that a scene states for its picture: `#iSize 800x450`.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "base/mapped_text.hpp"
#include "scene/channel.hpp"
#include "scene/knob.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::scene {

/// The size in an `#iSize` directive.
struct StatedSize {
    Extent extent;
    SourceLocation where{};
};

/// X11's limit for windows: it stores sizes in 16 bits with a sign.
inline constexpr int k_largest_stated_side = 32767;

/// Parses `800x450`; nullopt if it is something else or too large.
std::optional<Extent> size_of_text(std::string_view text);
std::string to_string(const Extent& size);

// A scene as values: its passes, the inputs of their channels, and its knobs.

enum class PassKind {
    buffer,
    cubemap,
    image,
    sound,
    hit, ///< Image, instrumented to output hits instead of colours: shader/survey.hpp
};

/// One unit of drawing (ShaderToy's render pass).
struct Pass {
    PassKind kind = PassKind::image;
    std::string name;      ///< "Image", "Buffer A": unique in its scene
    text::MappedText text; ///< includes pasted, directives blanked out, line numbers unchanged
    Channels channels;
    bool keyboard_helpers = false; ///< has `#iKeyboard`: isKeyDown(Key_A) and the like must be declared
    bool bare_file = false;    ///< not part of a project: SHADER_TOY is defined, as in the VS Code extension
    std::string definitions{}; ///< `#define` lines that precede the text, for names of other hosts
    bool stores_bytes = false; ///< a buffer of 8 bits a channel, as other hosts' `backbuffer`
};

struct Scene {
    std::filesystem::path file; ///< as named on the command line
    /// Precedes the text of every pass. As on ShaderToy a line end follows each Common, even after its last
    /// one.
    text::MappedText common;
    std::vector<Pass> passes; ///< in drawing order; a sound pass, if any, is last
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

// Changes a loaded scene as the options `--channel` and `--set` say.

/// Applies `--channel [PASS:]N=WHAT`, where WHAT is a picture file, `noise`, `none` or another input; sampled
/// like ShaderToy's textures.
Result<void> override_channel(Scene& scene, std::string_view setting);

/// Applies `--set NAME=VALUE`. Accepts a value outside the knob's range, with a warning.
Result<void> override_knob(Scene& scene, std::string_view setting);

/// Splits `NAME=VALUE`; the error names the option that needs this form.
Result<std::pair<std::string_view, std::string_view>> split_setting(std::string_view setting,
                                                                    std::string_view option);

} // namespace tidemark::scene
