// From a pass to the text the driver compiles: ShaderToy's prologue, Common, the author's text, our `main`.
// Pure text; no GL and no files.
#pragma once

#include "glsl/dialect.hpp"
#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

namespace tidemark::glsl {

/// A fragment shader with the way back to its authors' lines.
using ShaderSource = text::MappedText;

/// The fragment shader of `pass` in `dialect`, one of single precision. What the text declares itself is not
/// declared again. A buffer keeps the whole vec4 that the shader writes; Image writes alpha 1, whatever the
/// shader does.
///
/// Beside ShaderToy's own uniforms the host sets `vec3 tidemark_corners[4]` in a cubemap pass (directions at
/// the corners of the face, counter-clockwise from texel 0,0) and, where the text names them, the members of
/// `iCh0` … `iCh3` (sampler, size, time, loaded), of `iChannel[4]` (resolution, time) and `sampler2D
/// iKeyboard`.
ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect& dialect);

/// The same in the first dialect to try.
ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass);

/// The vertex shader that goes with a fragment shader of that version: one triangle that covers the target,
/// made from gl_VertexID alone. It hands `vec2 tidemark_tile` on to a fragment shader that is tiled.
const char* vertex_shader(Version version);

/// The vertex shader of every pass in a desktop version.
extern const char* const k_vertex_shader;

/// A Sound pass is drawn in squares of this many texels a side, one sample each (little-endian 16-bit left
/// and right in rgba).
inline constexpr int k_sound_tile = 512;

} // namespace tidemark::glsl
