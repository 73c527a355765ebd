#include "glsl/assemble.hpp"

#include "glsl/prologue.hpp"
#include "glsl/rewrite.hpp"
#include "glsl/survey.hpp"

namespace tidemark::glsl {

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass) {
    return assemble(scene, pass, dialects_to_try(scene, pass).front());
}

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect& dialect) {
    text::MappedText author = scene.common;
    author.append(pass.text);
    const auto tokens = text::tokenize(author.text());
    const Preprocessed preprocessed = preprocess(tokens);
    const Survey facts = survey(tokens, preprocessed, pass.kind);
    const Wrapper ours = wrapper(pass, facts, dialect);
    const Rewriting changes = rewrite(author.text(), tokens, preprocessed, facts, dialect);

    ShaderSource source;
    source.append_generated(prologue(scene, pass, facts, dialect, changes.extensions));
    if (dialect.main == MainPlace::first)
        source.append_generated(ours.prototype + ours.main);
    author.apply(changes.edits);
    source.append(author);
    if (dialect.main != MainPlace::first)
        source.append_generated("\n" + ours.main); // the author's last line may end in a backslash
    return source;
}

const char* const k_vertex_shader = R"(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

const char* vertex_shader(Version version) {
    return version != Version::es_300 ? k_vertex_shader : R"(#version 300 es
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";
}

} // namespace tidemark::glsl
