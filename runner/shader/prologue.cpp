#include "shader/rewrite.hpp"
#include "shader/shader_source.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {
namespace {

/// Features of WebGL 2 that `330 core` has only as extensions.
constexpr std::string_view k_core_330 = R"(#version 330 core
#extension GL_ARB_shading_language_packing : enable
#extension GL_ARB_shading_language_420pack : enable
#extension GL_ARB_shader_bit_encoding : enable
#extension GL_ARB_gpu_shader5 : enable
#extension GL_ARB_texture_gather : enable
#extension GL_ARB_arrays_of_arrays : enable
)";

/// Covers samplers too: their default is lowp, and Mesa then reads float buffers as halves. The macros
/// disable lower precisions in the author's text, since those have no effect on a desktop, where the scene
/// was written.
constexpr std::string_view k_es_precision = R"(precision highp float;
precision highp int;
precision highp sampler2D;
precision highp samplerCube;
precision highp sampler3D;
#define mediump highp
#define lowp highp
)";

/// The corner comes from the vertex shader: a flat input costs nothing, while drivers that draw on the CPU
/// reload a uniform for every few pixels. Multiples of 0.5 below 2^23 add without rounding; `precise` keeps a
/// compiler from merging this sum with the author's code.
constexpr const char* k_tile = R"(flat in vec2 tidemark_corner;
vec4 tidemark_frag_coord() {{
    {}vec4 at = gl_FragCoord + vec4(tidemark_corner, 0.0, 0.0);
    return at;
}}
#define gl_FragCoord tidemark_frag_coord()
)";

constexpr std::string_view k_assertions = R"(int tidemark_failed = -1;
void st_assert(bool holds, int kind) {
    if (!holds)
        tidemark_failed = kind;
}
void st_assert(bool holds) {
    st_assert(holds, 0);
}
)";

constexpr std::string_view k_paint_assertions =
    R"(    if (tidemark_failed >= 0)
        tidemark_color.rgb = tidemark_failed == 0   ? vec3(1.0, 0.0, 0.0)
                             : tidemark_failed == 1 ? vec3(0.0, 1.0, 0.0)
                             : tidemark_failed == 2 ? vec3(0.0, 0.0, 1.0)
                                                    : vec3(1.0, 1.0, 0.0);
)";

/// 0.2 is 51 of 255: image::k_non_finite_alpha. Tests the bits, because optimisers may assume that numbers
/// are finite.
constexpr const char* k_mark_non_finite =
    R"(    if (any(equal(floatBitsToUint({0}.rgb) & uvec3(0x7f800000u), uvec3(0x7f800000u))))
        {0}.a = 0.2;
)";

constexpr const char* k_image_main = R"(void main() {{
    vec4 tidemark_pixel = vec4(0.0, 0.0, 0.0, 1.0);
    vec2 tidemark_at = gl_FragCoord.xy;
    mainImage(tidemark_pixel, tidemark_at);
    tidemark_color = {};
{}{}}}
)";

constexpr const char* k_buffer_main = R"(void main() {{
    tidemark_color = vec4(0.0, 0.0, 0.0, 1.0);
    vec2 tidemark_at = gl_FragCoord.xy;
    {}(tidemark_color, tidemark_at);
}}
)";

constexpr std::string_view k_cubemap_main = R"(uniform vec3 tidemark_corners[4];
void main() {
    vec2 tidemark_at = gl_FragCoord.xy / iResolution.xy;
    vec3 tidemark_direction = mix(mix(tidemark_corners[0], tidemark_corners[1], tidemark_at.x),
                                  mix(tidemark_corners[3], tidemark_corners[2], tidemark_at.x), tidemark_at.y);
    tidemark_color = vec4(0.0, 0.0, 0.0, 1.0);
    mainCubemap(tidemark_color, gl_FragCoord.xy, vec3(0.0), normalize(tidemark_direction));
}
)";

constexpr const char* k_sound_main = R"(void main() {{
    int tidemark_local = int(gl_FragCoord.y) * {} + int(gl_FragCoord.x);
    vec2 tidemark_level = mainSound({}iTimeOffset + float(tidemark_local) / iSampleRate);
    vec2 tidemark_whole = floor((0.5 + 0.5 * tidemark_level) * 65536.0);
    vec2 tidemark_low = mod(tidemark_whole, 256.0) / 255.0;
    vec2 tidemark_high = floor(tidemark_whole / 256.0) / 255.0;
    tidemark_color = vec4(tidemark_low.x, tidemark_high.x, tidemark_low.y, tidemark_high.y);
}}
)";

std::string_view sampler_type(scene::TextureKind kind) {
    switch (kind) {
    case scene::TextureKind::flat: return "sampler2D";
    case scene::TextureKind::cube: return "samplerCube";
    case scene::TextureKind::volume: return "sampler3D";
    }
    return "sampler2D";
}

std::string macros(const Survey& survey, const Dialect& dialect) {
    std::string text;
    if (!survey.defines("HW_PERFORMANCE"))
        text += "#define HW_PERFORMANCE 1\n";
    if (dialect.version != Version::es_300 && survey.uses("GL_ES"))
        text += fmt::format("#define {} 1\n", k_es_macro);
    if (dialect.version != Version::es_300 && survey.uses("__VERSION__"))
        text += fmt::format("#define {} 300\n", k_version_macro);
    for (const OldName& old : k_old_names) {
        const auto found = survey.names.find(old.name);
        if (found == survey.names.end() || found->second.count == 0 || found->second.function ||
            found->second.macro)
            continue;
        // The author's uniform of that name was removed, so the macro must replace it.
        if (!found->second.variable && !survey.keeps_uniform(old.name))
            text += fmt::format("#define {} {}\n", old.name, old.today);
    }
    return text;
}

/// Returns ShaderToy's four channels, or all of the VS Code extension's if the text reads one of the others.
int channel_count(const Survey& survey) {
    for (size_t i = scene::k_site_channel_count; i < k_channel_names.size(); ++i)
        if (survey.wants(k_channel_names[i]))
            return scene::k_channel_count;
    return scene::k_site_channel_count;
}

std::string declare(const Survey& survey, std::string_view type, std::string_view name, int length = 0) {
    if (survey.keeps_uniform(name))
        return {};
    return length > 0 ? fmt::format("uniform {} {}[{}];\n", type, name, length)
                      : fmt::format("uniform {} {};\n", type, name);
}

/// Declares ShaderToy's uniforms; the arrays may be longer than ShaderToy's.
std::string site_uniforms(const scene::Pass& pass, const Survey& survey, const Dialect& dialect,
                          int channels) {
    std::string text;
    const bool sound = pass.kind == scene::PassKind::sound;
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        if (row.declared == scene::Declared::by_site && (sound ? row.sound : row.image))
            text += declare(survey, row.type, row.name, row.length > 0 ? channels : 0);
    for (size_t i = 0; i < k_channel_structs.size(); ++i) {
        const std::string_view type = sampler_type(dialect.channels[i]);
        text += declare(survey, type, k_channel_names[i]);
        if (survey.wants(k_channel_structs[i]))
            text += fmt::format("uniform struct {{ {} sampler; vec3 size; float time; int loaded; }} {};\n",
                                type, k_channel_structs[i]);
    }
    if (survey.wants("iChannel"))
        text += "uniform struct { vec3 resolution; float time; } iChannel[4];\n";
    return text;
}

/// Declares the uniforms of the VS Code extension, and knobs.
std::string more_uniforms(const scene::Scene& scene, const Survey& survey, const Dialect& dialect) {
    std::string text;
    for (size_t i = k_channel_structs.size(); i < k_channel_names.size(); ++i)
        if (survey.wants(k_channel_names[i]))
            text += declare(survey, sampler_type(dialect.channels[i]), k_channel_names[i]);
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        if (row.declared == scene::Declared::by_host_if_read && survey.wants(row.name))
            text += row.value == scene::HostValue::view && !scene.moves_view
                        ? fmt::format("const {0} {1} = {0}(1.0);\n", row.type, row.name)
                        : declare(survey, row.type, row.name);
    for (const scene::Knob& knob : scene.knobs)
        if (survey.uses(knob.name))
            text += declare(survey, scene::info(knob.type).glsl_name, knob.name);
    return text;
}

std::string output(const Survey& survey, const Dialect& dialect) {
    const bool own = dialect.main == MainPlace::author && !survey.own_output.empty();
    return own ? std::string() : fmt::format("layout(location = 0) out vec4 {};\n", k_output);
}

} // namespace

std::string version_lines(const Dialect& dialect, std::span<const std::string> extensions) {
    std::string text(dialect.version == Version::core_330   ? k_core_330
                     : dialect.version == Version::core_450 ? "#version 450 core\n"
                                                            : "#version 300 es\n");
    if (dialect.version == Version::core_330 && dialect.precision != Precision::single)
        text += "#extension GL_ARB_gpu_shader_fp64 : enable\n";
    for (const std::string& line : extensions)
        text += line;
    if (dialect.version == Version::es_300)
        text += k_es_precision;
    if (dialect.tiled) // in floats, whatever the precision
        text += fmt::format(k_tile, dialect.version == Version::es_300 ? "" : "precise ");
    return text;
}

std::string prologue(const scene::Scene& scene, const scene::Pass& pass, const Survey& survey,
                     const Dialect& dialect) {
    std::string text = macros(survey, dialect);
    text += site_uniforms(pass, survey, dialect, channel_count(survey));
    text += more_uniforms(scene, survey, dialect);
    text += output(survey, dialect);
    if (pass.keyboard_helpers)
        text += keyboard_helpers();
    const bool picture = pass.kind == scene::PassKind::image || pass.kind == scene::PassKind::hit;
    if (picture && survey.wants("st_assert"))
        text += k_assertions;
    return text;
}

std::string site_prologue(const scene::Pass& pass, const Survey& survey, const Dialect& dialect) {
    std::string text = version_lines(dialect, {});
    text += "#define HW_PERFORMANCE 1\n";
    text += site_uniforms(pass, survey, dialect, scene::k_site_channel_count);
    text += output(survey, dialect);
    if (survey.wants("st_assert"))
        text += k_assertions;
    return text;
}

Wrapper wrapper(const scene::Pass& pass, const Survey& survey, const Dialect& dialect) {
    const bool image = pass.kind == scene::PassKind::image;
    const auto mark = [&](std::string_view output) {
        return dialect.marks_non_finite ? fmt::format(k_mark_non_finite, output) : std::string();
    };
    if (dialect.main == MainPlace::author) {
        const bool own = !survey.own_output.empty();
        const std::string_view output = own ? survey.own_output : k_output;
        const bool has_alpha = !own || survey.own_output_type == "vec4";
        const std::string end = has_alpha && image && !dialect.keeps_alpha
                                    ? fmt::format("    {}.a = 1.0;\n{}", output, mark(output))
                                    : "";
        return {{},
                fmt::format("void main() {{\n{}    {}();\n{}}}\n",
                            has_alpha ? fmt::format("    {} = vec4(0.0, 0.0, 0.0, 1.0);\n", output) : "",
                            k_author_main, end)};
    }
    const std::string_view out = survey.entry_reads_colour ? "inout" : "out";
    switch (pass.kind) {
    case scene::PassKind::sound:
        if (survey.sound_takes_time_alone)
            return {"vec2 mainSound(float time);\n", fmt::format(k_sound_main, k_sound_tile, "")};
        return {"vec2 mainSound(int samp, float time);\n",
                fmt::format(k_sound_main, k_sound_tile, "iSampleOffset + tidemark_local, ")};
    case scene::PassKind::cubemap:
        return {fmt::format("void mainCubemap({} vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 "
                            "rayDir);\n",
                            out),
                std::string(k_cubemap_main)};
    default:
        return {fmt::format("void {}({} vec4 fragColor, in vec2 fragCoord);\n", entry_point(pass.kind), out),
                image ? fmt::format(k_image_main,
                                    dialect.keeps_alpha ? "tidemark_pixel" : "vec4(tidemark_pixel.rgb, 1.0)",
                                    mark(k_output), survey.wants("st_assert") ? k_paint_assertions : "")
                      : fmt::format(k_buffer_main, entry_point(pass.kind))};
    }
}

namespace {

struct Key {
    std::string_view name;
    int code; ///< JavaScript's key code
};

constexpr Key k_keys[] = {
    {"Backspace", 8},      {"Tab", 9},
    {"Enter", 13},         {"Shift", 16},
    {"Ctrl", 17},          {"Alt", 18},
    {"Pause", 19},         {"Caps", 20},
    {"Escape", 27},        {"Space", 32},
    {"PageUp", 33},        {"PageDown", 34},
    {"End", 35},           {"Home", 36},
    {"LeftArrow", 37},     {"UpArrow", 38},
    {"RightArrow", 39},    {"DownArrow", 40},
    {"Insert", 45},        {"Delete", 46},
    {"LeftWindow", 91},    {"RightWindow", 92},
    {"Select", 93},        {"NumpadMultiply", 106},
    {"NumpadAdd", 107},    {"NumpadSubtract", 109},
    {"NumpadPeriod", 110}, {"NumpadDivide", 111},
    {"NumLock", 144},      {"ScrollLock", 145},
    {"SemiColon", 186},    {"Equal", 187},
    {"Comma", 188},        {"Dash", 189},
    {"Period", 190},       {"ForwardSlash", 191},
    {"GraveAccent", 192},  {"OpenBracket", 219},
    {"BackSlash", 220},    {"CloseBracket", 221},
    {"CloseBraket", 221},  {"SingleQuote", 222},
};

constexpr std::string_view k_key_functions[] = {"isKeyDown", "isKeyPressed", "isKeyToggled", "isKeyReleased"};

} // namespace

std::string keyboard_helpers() {
    std::string text = "uniform sampler2D iKeyboard;\n";
    for (size_t row = 0; row < std::size(k_key_functions); ++row)
        text +=
            fmt::format("bool {}(int key) {{ return texelFetch(iKeyboard, ivec2(key, {}), 0).x > 0.0; }}\n",
                        k_key_functions[row], row);
    const auto add = [&](std::string_view name, int code) {
        text += fmt::format("const int Key_{} = {};\n", name, code);
    };
    for (const Key& key : k_keys)
        add(key.name, key.code);
    for (char c = '0'; c <= '9'; ++c) {
        add(std::string(1, c), c);
        add(fmt::format("Numpad{}", c), 96 + (c - '0'));
    }
    for (char c = 'A'; c <= 'Z'; ++c)
        add(std::string(1, c), c);
    for (int i = 1; i <= 12; ++i)
        add(fmt::format("F{}", i), 111 + i);
    return text;
}

} // namespace tidemark::glsl
