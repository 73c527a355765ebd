#include "lab/setting.hpp"

#include "base/hint.hpp"
#include "base/trimmed.hpp"
#include "base/try.hpp"
#include "glsl/overrides.hpp"
#include "lab/placed_number.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace tidemark::lab {
namespace {

/// Splits at commas outside parentheses and trims the parts.
std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    int depth = 0;
    size_t begin = 0;
    for (size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && (text[i] == '(' || text[i] == ')'))
            depth += text[i] == '(' ? 1 : -1;
        if (i < text.size() && (text[i] != ',' || depth > 0))
            continue;
        parts.emplace_back(trimmed(text.substr(begin, i - begin)));
        begin = i + 1;
    }
    return parts;
}

Error no_such_name(const scene::Scene& scene, std::string_view name) {
    std::vector<std::string> names = glsl::definition_names(scene);
    for (const scene::Knob& knob : scene.knobs)
        names.push_back(knob.name);
    return {ErrorCode::usage,
            fmt::format("the scene has no #iUniform, #define or const '{}': {}", name,
                        hint_for(name, names, "it has none at all")),
            {}};
}

/// Applies the change to all texts; returns false if one of them no longer contains the number.
bool replace(scene::Scene& scene, const glsl::Cure& number) {
    bool whole = glsl::apply(scene.common, std::span(&number, 1));
    for (scene::Pass& pass : scene.passes)
        whole = glsl::apply(pass.text, std::span(&number, 1)) && whole;
    return whole;
}

} // namespace

Result<Axis> parse_axis(std::string_view text, std::string_view option) {
    const size_t equals = text.find('=');
    Axis axis;
    if (equals != text.npos) {
        axis.name = trimmed(text.substr(0, equals));
        axis.values = split(text.substr(equals + 1));
    }
    const bool gap = std::ranges::any_of(axis.values, [](const std::string& value) { return value.empty(); });
    if (axis.name.empty() || axis.values.empty() || gap)
        return fail(ErrorCode::usage,
                    fmt::format("{} {}: give NAME=a,b,c, none of them empty", option, text));
    return axis;
}

Result<std::vector<Setting>> parse_settings(std::string_view text, std::string_view option) {
    std::vector<Setting> settings;
    for (const std::string& part : split(text)) {
        auto axis = parse_axis(part, option);
        if (!axis)
            return fail(ErrorCode::usage, fmt::format("{} {}: give NAME=V or NAME=V,NAME=V", option, text));
        settings.push_back({axis->name, axis->values.front()});
    }
    return settings;
}

std::vector<Setting> merged(const std::vector<Setting>& settings) {
    std::vector<Setting> last;
    for (const Setting& setting : settings) {
        const auto known = std::ranges::find(last, setting.name, &Setting::name);
        if (known != last.end())
            known->value = setting.value;
        else
            last.push_back(setting);
    }
    return last;
}

std::string to_string(const std::vector<Setting>& settings) {
    std::string text;
    for (const Setting& setting : settings)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.name, setting.value);
    return text.empty() ? "defaults" : text;
}

bool is_knob(const scene::Scene& scene, std::string_view name) {
    return std::ranges::find(scene.knobs, name, &scene::Knob::name) != scene.knobs.end();
}

Result<void> apply(scene::Scene& scene, const Setting& setting) {
    const std::string text = setting.name + "=" + setting.value;
    if (is_knob(scene, setting.name))
        return scene::override_knob(scene, text);
    if (glsl::definition_of(scene, setting.name))
        return glsl::override_definition(scene, text);
    if (const auto number = number_at(scene, setting.name))
        if (replace(scene, replaced(*number, setting.value)))
            return {};
    return fail(no_such_name(scene, setting.name));
}

Result<scene::Scene> with(scene::Scene scene, const std::vector<Setting>& settings) {
    for (const Setting& setting : settings)
        TRY(apply(scene, setting));
    return scene;
}

std::string value_of(const scene::Scene& scene, std::string_view name) {
    const auto knob = std::ranges::find(scene.knobs, name, &scene::Knob::name);
    if (knob != scene.knobs.end())
        return scene::to_string(*knob);
    if (const auto defined = glsl::definition_of(scene, name))
        return *defined;
    const auto number = number_at(scene, name);
    return number ? number->word : std::string();
}

} // namespace tidemark::lab
