// Builds the text of a pass for the driver: ShaderToy's prologue, Common, the author's text, Tidemark's
// `main`. Text only; uses no GL and no files.
#pragma once

#include "glsl/dialect.hpp"
#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

namespace tidemark::glsl {

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
