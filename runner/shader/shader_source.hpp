// The GLSL variants in which a pass can be passed to the driver. ShaderToy's texts are written for WebGL 2;
// desktop drivers accept nearly all of them as `330 core`, and most others in another version or with `main`
// in another place. Text only.
#pragma once

#include "base/mapped_text.hpp"
#include "scene/scene.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Values of `#version`, preferred ones first: see runner/cli/manual/scenes.md, "Dialect".
enum class Version { core_330, core_450, es_300 };

/// Precision of the author's floats.
enum class Precision {
    single,
    promoted,      ///< doubles, except in hashes (find_float_regions)
    promoted_whole ///< doubles, in hashes too
};

/// Position of the `main` that calls the author's entry point.
enum class MainPlace {
    first, ///< before the text, so that the author's macros do not change it
    last,  ///< after the text, for an entry point that is a macro
    author ///< the text has its own `main`
};

using ChannelKinds = std::array<scene::TextureKind, scene::k_channel_count>;

/// One way to present a pass to the driver.
struct Dialect {
    Version version = Version::core_330;
    MainPlace main = MainPlace::first;
    bool initialise = true; ///< variables without a value start at zero: start_at_zero()
    ChannelKinds channels{};
    Precision precision = Precision::single;
    bool joins_overloads = false; ///< functions named like built-in ones overload them: join_overloads()
    /// gl_FragCoord is relative to the corner of the whole picture, not of the target: the host sets `vec2
    /// tidemark_tile`, in pixels.
    bool tiled = false;
    /// A NaN or infinite pixel of Image, which bytes cannot hold, gets the alpha image::k_non_finite_alpha
    /// instead of 1.
    bool marks_non_finite = false;
    /// Image keeps the alpha that its text writes, instead of 1.
    bool keeps_alpha = false;

    bool operator==(const Dialect&) const = default;
};

/// Returns "330 core" followed by what differs from the default: "300 es, main last".
std::string to_string(const Dialect& dialect);

/// Call after the driver rejected `source` with `log`. Returns kinds for the channels whose input is
/// unspecified, the likeliest first, cubes before volumes; empty if the log has no error about samplers.
std::vector<ChannelKinds> channel_kinds_to_try(const scene::Scene& scene, const scene::Pass& pass,
                                               const text::MappedText& source, std::string_view log);

// Builds the text of a pass for the driver: ShaderToy's prologue, Common, the author's text, Tidemark's
// `main`. Text only; uses no GL and no files.

/// A fragment shader that maps each line back to its author's.
using ShaderSource = text::MappedText;

/// Returns the fragment shader of `pass` in `dialect`, which has single precision. Names that the text
/// declares itself are not declared again. A buffer keeps the whole vec4 that the shader writes; Image writes
/// alpha 1 unless the dialect says otherwise.
///
/// In addition to ShaderToy's uniforms the host sets `vec3 tidemark_corners[4]` in a cubemap pass (directions
/// at the corners of the face, counter-clockwise from texel 0,0) and, if the text names them, the members of
/// `iCh0` … `iCh3` (sampler, size, time, loaded), of `iChannel[4]` (resolution, time), and `sampler2D
/// iKeyboard`.
ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect& dialect);

/// Returns the same in the pass's first dialect.
ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass);

/// Returns the vertex shader for fragment shaders of that version: one triangle that covers the target, made
/// from gl_VertexID alone. It passes the uniform `vec2 tidemark_tile` on to a tiled fragment shader.
const char* vertex_shader(Version version);

/// The vertex shader of all passes in desktop versions.
extern const char* const k_vertex_shader;

/// Side in texels of the squares in which a Sound pass is drawn; one texel per sample (little-endian 16-bit
/// left and right in rgba).
inline constexpr int k_sound_tile = 512;

} // namespace tidemark::glsl
