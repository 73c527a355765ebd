#include "cli/view/held_values.hpp"

#include "glsl/overrides.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

constexpr std::string_view k_set = "--set";
constexpr std::string_view k_define = "--define";

bool is_edited(const HeldValue& held, const std::vector<HeldValue>& before) {
    const auto known =
        std::ranges::find_if(before, [&](const HeldValue& other) { return held.is_of(other); });
    return known != before.end() && known->in_file != held.in_file;
}

/// Returns whether `NAME=VALUE` sets that name.
bool names(std::string_view setting, std::string_view name) {
    const auto split = scene::split_setting(setting, k_set);
    return split && split->first == name;
}

} // namespace

std::vector<HeldValue> held_values(const SceneRequest& request, const scene::Scene& scene) {
    std::vector<HeldValue> held;
    const auto hold = [&held](std::string_view option, const auto& setting, std::string in_file) {
        held.push_back({option, std::string(setting.first), std::string(setting.second), std::move(in_file)});
    };
    for (const std::string& text : request.sets)
        if (const auto setting = scene::split_setting(text, k_set))
            for (const scene::Knob& knob : scene.knobs)
                if (knob.name == setting->first)
                    hold(k_set, *setting, to_string(knob, knob.initial));
    for (const std::string& text : request.defines)
        if (const auto setting = scene::split_setting(text, k_define))
            if (auto defined = glsl::definition_of(scene, setting->first))
                hold(k_define, *setting, *std::move(defined));
    return held;
}

SceneRequest without_edited(SceneRequest request, const std::vector<HeldValue>& before,
                            const std::vector<HeldValue>& now) {
    for (const HeldValue& held : now)
        if (held.option == k_set && is_edited(held, before))
            std::erase_if(request.sets, [&](const std::string& text) { return names(text, held.name); });
    return request;
}

std::vector<std::string> edits_of_held(const std::vector<HeldValue>& before,
                                       const std::vector<HeldValue>& now) {
    std::vector<std::string> lines;
    for (const HeldValue& held : now)
        if (is_edited(held, before))
            lines.push_back(held.option == k_set
                                ? fmt::format("{} is {} now, as the file says: {} {}={} is over", held.name,
                                              held.in_file, held.option, held.name, held.value)
                                : fmt::format("{} stays {} as {} says; the file's definition is now {}",
                                              held.name, held.value, held.option, held.in_file));
    return lines;
}

std::vector<std::string> edits_of_turned(const std::vector<scene::Knob>& before,
                                         const std::vector<scene::Knob>& now,
                                         const std::vector<scene::Setting>& turned) {
    std::vector<std::string> lines;
    for (const scene::Knob& knob : now) {
        const auto known = std::ranges::find(before, knob.name, &scene::Knob::name);
        const auto value = value_after(knob, turned);
        if (known != before.end() && known->initial != knob.initial && value != knob.initial &&
            std::ranges::find(turned, knob.name, &scene::Setting::name) != turned.end())
            lines.push_back(fmt::format("{} stays {} as it was turned; the file's default is now {}",
                                        knob.name, to_string(knob, value), to_string(knob, knob.initial)));
    }
    return lines;
}

} // namespace tidemark::cli
