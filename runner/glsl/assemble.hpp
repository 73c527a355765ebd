// From a pass to the text the driver compiles: ShaderToy's prologue, the author's text, our `main`.
// Pure text; no GL and no files.
#pragma once

#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

namespace tidemark::glsl {

/// A fragment shader with the way back to its authors' lines.
using ShaderSource = text::MappedText;

/// The fragment shader of `pass`. What the text declares itself is not declared again. The Image pass
/// writes alpha 1, whatever the shader does.
ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass);

/// The vertex shader of every pass: one triangle that covers the target, made from gl_VertexID alone.
extern const char* const k_vertex_shader;

} // namespace tidemark::glsl
