#include "lsp/hover.hpp"

#include "glsl/syntax/builtin_functions.hpp"
#include "glsl/syntax/words.hpp"
#include "lsp/comments.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lsp {
namespace {

std::string code(std::string_view text) {
    return fmt::format("```glsl\n{}\n```\n", text);
}

std::string of_knob(const scene::Knob& knob) {
    std::string text = code(fmt::format("uniform {} {}", info(knob.type).glsl_name, knob.name));
    text += fmt::format("Knob, {} at first", scene::to_string(knob, knob.initial));
    if (knob.range)
        text += fmt::format(", from {} to {}", scene::to_string(knob, knob.range->low),
                            scene::to_string(knob, knob.range->high));
    if (knob.step)
        text += fmt::format(", in steps of {}", scene::to_string(knob, *knob.step));
    return text + ".\n";
}

std::string signature(const glsl::BuiltinFunction& function, const glsl::BuiltinOverload& overload) {
    std::string parameters;
    for (const glsl::BuiltinParameter& parameter : overload.parameters)
        parameters += fmt::format("{}{}{}", parameters.empty() ? "" : ", ", parameter.written ? "out " : "",
                                  parameter.type);
    return fmt::format("{} {}({})", overload.result, function.name, parameters);
}

/// Signatures in one hover text; functions of vectors have one for each vector size.
constexpr size_t k_most_signatures = 8;

std::string of_builtin(const glsl::BuiltinFunction& function) {
    std::string signatures;
    const auto overloads = glsl::overloads_of(function);
    for (size_t i = 0; i < std::min(overloads.size(), k_most_signatures); ++i)
        signatures += (i > 0 ? "\n" : "") + signature(function, overloads[i]);
    if (overloads.size() > k_most_signatures)
        signatures += fmt::format("\n// and {} more", overloads.size() - k_most_signatures);
    std::string text = code(signatures);
    if (function.domain)
        for (const glsl::UndefinedWhere& where : function.domain->undefined)
            if (!where.fault.empty())
                text += fmt::format("Undefined {}.\n", where.fault);
    if (!function.in_es())
        text += fmt::format("Not in GLSL ES 3.00, which ShaderToy's site compiles: {}.\n", function.instead);
    return text;
}

std::string of_symbol(const SourceFile& file, const Symbol& symbol, bool elsewhere) {
    std::string text = code(symbol.signature);
    if (!symbol.comment.empty())
        text += symbol.comment + "\n";
    if (elsewhere)
        text += fmt::format("\nFrom `{}`.\n", file.path.filename().string());
    return text;
}

/// Describes a channel. Leaves out the sampler type, which depends on the input that the pass reads.
std::string of_channel(std::string_view name) {
    return fmt::format(
        "Input {} of the pass: a texture, a video, the keyboard, a cubemap or another pass, as "
        "`#{} \"…\"` or the scene's channels say.\n",
        name.back(), name);
}

/// A uniform that a scene may declare to get a value from this host, in addition to ShaderToy's.
struct OwnUniform {
    std::string_view name, meaning;
};

constexpr OwnUniform k_own_uniforms[] = {
    {scene::k_camera_uniform, "the orbit camera, camera to world: right, up, backwards, position"},
    {scene::k_orbit_uniform, "how the orbit camera was moved: azimuth, elevation, distance, 1 once it was"},
    {scene::k_orbit_pan_uniform, "how the orbit camera's target was moved, in first distances"},
    {scene::k_time_low_uniform, "what iTime as a float leaves of the seconds"},
    {scene::k_mouse_button_uniform, "1 while a button is down: x left, y right"},
    {scene::k_view_uniform, "a camera to world, the identity until a person moves it"}};

std::string of_own_uniform(std::string_view name) {
    const auto own = std::ranges::find(k_own_uniforms, name, &OwnUniform::name);
    return own == std::end(k_own_uniforms) ? "" : fmt::format("Given by this host: {}.\n", own->meaning);
}

std::string of_host(std::string_view name) {
    if (std::ranges::find(scene::k_channel_names, name) != scene::k_channel_names.end())
        return of_channel(name);
    const auto uniform = std::ranges::find(scene::k_site_uniforms, name, &scene::SiteUniform::name);
    if (uniform == std::end(scene::k_site_uniforms))
        return of_own_uniform(name);
    const std::string length = uniform->length > 0 ? fmt::format("[{}]", uniform->length) : "";
    return code(fmt::format("uniform {} {}{}", uniform->type, name, length)) +
           "Given by the host, as on ShaderToy's site.\n";
}

} // namespace

std::string hover_text(const Workspace& workspace, size_t offset, const Documents& documents) {
    if (const auto included = included_at(workspace, offset); !included.empty()) {
        const auto text = documents.text_of(included);
        return text && workspace.may_read(included)
                   ? fmt::format("`{}`\n\n{}\n", included.string(), leading_comment(*text))
                   : "";
    }
    const auto tokens = text::tokenize(workspace.files.front().text);
    const auto word = word_at(tokens, offset);
    if (!word)
        return {};
    if (const scene::Knob* knob = workspace.knob(word->text))
        return of_knob(*knob);
    std::string text;
    for (const SourceFile& file : workspace.files)
        for (const Symbol& symbol : file.symbols)
            if (symbol.name == word->text)
                text += of_symbol(file, symbol, &file != &workspace.files.front());
    if (!text.empty())
        return text + of_own_uniform(word->text);
    if (const glsl::BuiltinFunction* function = glsl::find_builtin(word->text))
        return of_builtin(*function);
    const auto old = std::ranges::find(glsl::k_old_names, word->text, &glsl::OldName::name);
    if (old == std::end(glsl::k_old_names))
        return of_host(word->text);
    const glsl::BuiltinFunction* const today = glsl::find_builtin(old->today);
    return fmt::format("An older name of `{}`.\n\n", old->today) +
           (today ? of_builtin(*today) : of_host(old->today));
}

} // namespace tidemark::lsp
