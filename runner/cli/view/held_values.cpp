#include "cli/view/held_values.hpp"

#include "glsl/overrides.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

constexpr std::string_view k_set = "--set";
constexpr std::string_view k_define = "--define";

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

std::vector<std::string> edited_in_vain(const std::vector<HeldValue>& before,
                                        const std::vector<HeldValue>& now) {
    std::vector<std::string> lines;
    for (const HeldValue& held : now) {
        const auto known =
            std::ranges::find_if(before, [&](const HeldValue& other) { return held.is_of(other); });
        if (known != before.end() && known->in_file != held.in_file)
            lines.push_back(fmt::format("{} stays {} as {} says; the file's {} is now {}", held.name,
                                        held.value, held.option,
                                        held.option == k_set ? "default" : "definition", held.in_file));
    }
    return lines;
}

} // namespace tidemark::cli
