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
};

/// Sound is not drawn at any time of a picture: it has uniforms of its own.
constexpr Declaration k_sound_uniforms[] = {
    {"iDate", "vec4 iDate"},
    {"iSampleRate", "float iSampleRate"},
    {"iChannelTime", "float iChannelTime[4]"},
    {"iChannelResolution", "vec3 iChannelResolution[4]"},
    {"iTimeOffset", "float iTimeOffset"},
    {"iSampleOffset", "int iSampleOffset"},
};

/// What stands around the author's text for one kind of pass. The local colour starts at (0,0,0,1): golfed
/// shaders read it before they write it.
struct Wrapper {
    std::string_view entry;     ///< what the author defines
    std::string_view prototype; ///< so that main can stand first
    std::string_view main;
};

constexpr Wrapper k_image{"mainImage", "void mainImage(out vec4 fragColor, in vec2 fragCoord);\n",
                          R"(out vec4 tidemark_color;
void main() {
    vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
    mainImage(color, gl_FragCoord.xy);
    tidemark_color = vec4(color.rgb, 1.0);
}
)"};

constexpr Wrapper k_buffer{"mainImage", k_image.prototype,
                           R"(out vec4 tidemark_color;
void main() {
    tidemark_color = vec4(0.0, 0.0, 0.0, 1.0);
    mainImage(tidemark_color, gl_FragCoord.xy);
}
)"};

constexpr Wrapper k_cubemap{
    "mainCubemap",
    "void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir);\n",
    R"(uniform vec3 tidemark_corners[4];
out vec4 tidemark_color;
void main() {
    vec2 at = gl_FragCoord.xy / iResolution.xy;
    vec3 direction = mix(mix(tidemark_corners[0], tidemark_corners[1], at.x),
                         mix(tidemark_corners[3], tidemark_corners[2], at.x), at.y);
    tidemark_color = vec4(0.0, 0.0, 0.0, 1.0);
    mainCubemap(tidemark_color, gl_FragCoord.xy, vec3(0.0), normalize(direction));
}
)"};

/// Older sound shaders take the time alone.
constexpr std::string_view k_sound_prototypes[] = {"vec2 mainSound(int samp, float time);\n",
                                                   "vec2 mainSound(float time);\n"};
constexpr std::string_view k_sound_calls[] = {"mainSound(samp, time)", "mainSound(time)"};
constexpr const char* k_sound_main = R"(out vec4 tidemark_color;
void main() {{
    int local = int(gl_FragCoord.y) * {} + int(gl_FragCoord.x);
    int samp = iSampleOffset + local;
    float time = iTimeOffset + float(local) / iSampleRate;
    vec2 level = {};
    vec2 whole = floor((0.5 + 0.5 * level) * 65536.0);
    vec2 low = mod(whole, 256.0) / 255.0;
    vec2 high = floor(whole / 256.0) / 255.0;
    tidemark_color = vec4(low.x, high.x, low.y, high.y);
}}
)";

/// What a reader of the text must know before the prologue is written.
struct TextFacts {
    std::set<std::string_view> own_uniforms; ///< declared by the author, outside any #if
    bool entry_is_macro = false;             ///< golf: `#define mainImage(O,U) …`
    bool sound_takes_time_alone = false;     ///< `mainSound(float time)`
    std::vector<text::Edit> edits;           ///< the author's #version, which must not stand twice
};

bool begins_directive(const Token& token) {
    return token.first_on_line && token.is("#");
}

/// Whether a declaration of uniforms ends here at the latest, however unfinished it is.
bool ends_uniform(const Token& token) {
    return token.is(";") || token.is("uniform") || begins_directive(token);
}

bool first_parameter_is_float(const std::vector<Token>& tokens, size_t at) {
    while (at < tokens.size() && (tokens[at].is("in") || tokens[at].is("const")))
        ++at;
    return at < tokens.size() && tokens[at].is("float");
}

TextFacts read_facts(const std::vector<Token>& tokens, std::string_view entry) {
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
            else if (next.is("define") && i + 2 < tokens.size() && tokens[i + 2].is(entry))
                facts.entry_is_macro = true;
            i = end;
        } else if (token.is("uniform") && conditional_depth == 0) {
            for (++i; i < tokens.size() && !ends_uniform(tokens[i]); ++i)
                facts.own_uniforms.insert(tokens[i].text);
        } else {
            if (token.is("mainSound") && next.is("("))
                facts.sound_takes_time_alone =
                    facts.sound_takes_time_alone || first_parameter_is_float(tokens, i + 2);
            ++i;
        }
    }
    return facts;
}

std::string_view sampler_type(scene::TextureKind kind) {
    switch (kind) {
    case scene::TextureKind::flat: return "sampler2D";
    case scene::TextureKind::cube: return "samplerCube";
    case scene::TextureKind::volume: return "sampler3D";
    }
    return "sampler2D";
}

std::string declare_uniforms(const scene::Scene& scene, const scene::Pass& pass, const TextFacts& facts) {
    std::string text;
    const auto declare = [&](std::string_view name, std::string_view declaration) {
        if (!facts.own_uniforms.contains(name))
            text += fmt::format("uniform {};\n", declaration);
    };
    if (pass.kind == scene::PassKind::sound)
        for (const Declaration& uniform : k_sound_uniforms)
            declare(uniform.name, uniform.text);
    else
        for (const Declaration& uniform : k_uniforms)
            declare(uniform.name, uniform.text);
    for (int i = 0; i < scene::k_channel_count; ++i) {
        const std::string name = fmt::format("iChannel{}", i);
        declare(name, fmt::format("{} {}", sampler_type(texture_kind(scene, pass.channels[size_t(i)].input)),
                                  name));
    }
    for (const scene::Knob& knob : scene.knobs)
        declare(knob.name, fmt::format("{} {}", scene::info(knob.type).glsl_name, knob.name));
    return text;
}

struct WrapperText {
    std::string prototype;
    std::string main;
};

WrapperText wrapper_of(scene::PassKind kind, const TextFacts& facts) {
    switch (kind) {
    case scene::PassKind::image: return {std::string(k_image.prototype), std::string(k_image.main)};
    case scene::PassKind::buffer: return {std::string(k_buffer.prototype), std::string(k_buffer.main)};
    case scene::PassKind::cubemap: return {std::string(k_cubemap.prototype), std::string(k_cubemap.main)};
    case scene::PassKind::sound: break;
    }
    const size_t form = facts.sound_takes_time_alone ? 1 : 0;
    return {std::string(k_sound_prototypes[form]),
            fmt::format(k_sound_main, k_sound_tile, k_sound_calls[form])};
}

std::string_view entry_of(scene::PassKind kind) {
    return kind == scene::PassKind::sound     ? "mainSound"
           : kind == scene::PassKind::cubemap ? k_cubemap.entry
                                              : k_image.entry;
}

} // namespace

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass) {
    return assemble(scene, pass, dialects_to_try(scene, pass).front());
}

ShaderSource assemble(const scene::Scene& scene, const scene::Pass& pass, const Dialect&) {
    text::MappedText author = scene.common;
    author.append(pass.text);
    const auto tokens = text::tokenize(author.text());
    const TextFacts facts = read_facts(tokens, entry_of(pass.kind));
    const WrapperText wrapper = wrapper_of(pass.kind, facts);
    ShaderSource source;
    source.append_generated(k_header);
    source.append_generated(declare_uniforms(scene, pass, facts));
    author.apply(facts.edits);

    // Our main stands first, because authors' macros may rename what it uses; but an entry point that is
    // itself a macro must be defined before it is called.
    if (!facts.entry_is_macro)
        source.append_generated(wrapper.prototype + wrapper.main);
    source.append(author);
    if (facts.entry_is_macro)
        source.append_generated(wrapper.main);
    return source;
}

const char* const k_vertex_shader = R"(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

const char* vertex_shader(Version) {
    return k_vertex_shader;
}

} // namespace tidemark::glsl
