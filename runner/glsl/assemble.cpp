#include "glsl/assemble.hpp"

#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace tidemark::glsl {
namespace {

using text::Token;

/// WebGL 2 has these; `330 core` needs to be told.
constexpr const char* k_header = R"(#version 330 core
#extension GL_ARB_shading_language_packing : enable
#extension GL_ARB_shading_language_420pack : enable
#extension GL_ARB_shader_bit_encoding : enable
#extension GL_ARB_gpu_shader5 : enable
#extension GL_ARB_texture_gather : enable
#extension GL_ARB_arrays_of_arrays : enable
#define HW_PERFORMANCE 1
)";

struct Declaration {
    std::string_view name;
    std::string_view text;
};

constexpr Declaration k_uniforms[] = {
    {"iResolution", "vec3 iResolution"},
    {"iTime", "float iTime"},
    {"iTimeDelta", "float iTimeDelta"},
    {"iFrameRate", "float iFrameRate"},
    {"iFrame", "int iFrame"},
    {"iMouse", "vec4 iMouse"},
    {"iDate", "vec4 iDate"},
    {"iSampleRate", "float iSampleRate"},
    {"iChannelTime", "float iChannelTime[4]"},
    {"iChannelResolution", "vec3 iChannelResolution[4]"},
    {"iChannel0", "sampler2D iChannel0"},
    {"iChannel1", "sampler2D iChannel1"},
    {"iChannel2", "sampler2D iChannel2"},
    {"iChannel3", "sampler2D iChannel3"},
};

constexpr const char* k_prototype = "void mainImage(out vec4 fragColor, in vec2 fragCoord);\n";

constexpr const char* k_main = R"(out vec4 tidemark_color;
void main() {
    vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
    mainImage(color, gl_FragCoord.xy);
    tidemark_color = vec4(color.rgb, 1.0);
}
)";

/// What a reader of the text must know before the prologue is written.
struct TextFacts {
    std::set<std::string_view> own_uniforms; ///< declared by the author, outside any #if
    bool main_image_is_macro = false;        ///< golf: `#define mainImage(O,U) …`
    std::vector<text::Edit> edits;           ///< the author's #version, which must not stand twice
};

bool begins_directive(const Token& token) {
    return token.first_on_line && token.is("#");
}

/// Whether a declaration of uniforms ends here at the latest, however unfinished it is.
bool ends_uniform(const Token& token) {
    return token.is(";") || token.is("uniform") || begins_directive(token);
}

TextFacts read_facts(const std::vector<Token>& tokens) {
    TextFacts facts;
    int conditional_depth = 0;
    for (size_t i = 0; i + 1 < tokens.size();) {
        const Token& token = tokens[i];
        const Token& next = tokens[i + 1];
        if (begins_directive(token)) {
            const size_t end = text::end_of_directive(tokens, i);
            if (next.text.starts_with("if"))
                ++conditional_depth;
            else if (next.is("endif"))
                conditional_depth = std::max(0, conditional_depth - 1);
            else if (next.is("version"))
                facts.edits.push_back({token.begin, tokens[end - 1].end(), {}});
            else if (next.is("define") && i + 2 < tokens.size() && tokens[i + 2].is("mainImage"))
                facts.main_image_is_macro = true;
            i = end;
        } else if (token.is("uniform") && conditional_depth == 0) {
            for (++i; i < tokens.size() && !ends_uniform(tokens[i]); ++i)
                facts.own_uniforms.insert(tokens[i].text);
        } else {
            ++i;
        }
    }
    return facts;
}

} // namespace

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass) {
    const auto tokens = text::tokenize(pass.text.text());
    const TextFacts facts = read_facts(tokens);

    std::string prologue = k_header;
    for (const Declaration& uniform : k_uniforms)
        if (!facts.own_uniforms.contains(uniform.name))
            prologue += fmt::format("uniform {};\n", uniform.text);
    for (const scene::Knob& knob : scene.knobs)
        if (!facts.own_uniforms.contains(knob.name))
            prologue += fmt::format("uniform {} {};\n", scene::info(knob.type).glsl_name, knob.name);

    text::MappedText author = pass.text;
    author.apply(facts.edits);

    // Our main stands first, because authors' macros may rename what it uses; but a mainImage that is itself
    // a macro must be defined before it is called.
    ShaderSource source;
    source.append_generated(prologue);
    if (!facts.main_image_is_macro)
        source.append_generated(std::string(k_prototype) + k_main);
    source.append(author);
    if (facts.main_image_is_macro)
        source.append_generated(k_main);
    return source;
}

const char* const k_vertex_shader = R"(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

} // namespace tidemark::glsl
