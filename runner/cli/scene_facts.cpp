#include "cli/scene_facts.hpp"

#include "cli/json_dump.hpp"
#include "cli/version.hpp"
#include "glsl/overrides.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tidemark::cli {
namespace {

std::vector<double> components_of(const scene::Knob& knob, const scene::KnobValue& value) {
    return {value.begin(), value.begin() + scene::info(knob.type).components};
}

/// Returns true if the input was assigned. Otherwise it is the default noise, which is present in case a
/// program reads it.
bool is_chosen(const scene::Channel& channel) {
    return !channel.where.file.empty() || !traits_of(channel.input).default_input;
}

/// Replaces each run of white space by one space, and truncates after 60 bytes.
std::string in_short(std::string_view text) {
    constexpr size_t k_longest = 60;
    std::string line;
    for (const char c : text)
        if (c != ' ' && c != '\n' && c != '\t')
            line += c;
        else if (!line.ends_with(' '))
            line += ' ';
    return line.size() <= k_longest ? line : line.substr(0, k_longest) + "…";
}

} // namespace

std::string describe(const scene::Scene& scene, const scene::Channel& channel) {
    if (const size_t* pass = source_pass(channel.input))
        return scene.passes[*pass].name;
    const auto files = input_files(channel.input);
    return files.empty() ? std::string(traits_of(channel.input).name) : files.front().string();
}

bool may_feed_back(const scene::Scene& scene) {
    return std::ranges::any_of(scene.passes, [](const scene::Pass& pass) {
        return pass.kind == scene::PassKind::buffer || pass.kind == scene::PassKind::cubemap;
    });
}

Json files_of(const scene::Scene& scene) {
    Json files = Json::array();
    for (const auto& file : scene.files)
        files.push_back(file.string());
    return files;
}

Json knobs_of(const scene::Scene& scene) {
    Json knobs = Json::array();
    for (const scene::Knob& knob : scene.knobs) {
        Json& json = knobs.emplace_back(Json{{"name", knob.name},
                                             {"type", scene::info(knob.type).directive_name},
                                             {"value", components_of(knob, knob.value)}});
        if (knob.range) {
            json["low"] = components_of(knob, knob.range->low);
            json["high"] = components_of(knob, knob.range->high);
        }
    }
    return knobs;
}

std::string knob_lines(const scene::Scene& scene) {
    std::string text;
    for (const scene::Knob& knob : scene.knobs) {
        text += fmt::format("  knob      {} {} = {}", scene::info(knob.type).directive_name, knob.name,
                            scene::to_string(knob));
        if (knob.range)
            text += fmt::format(" in {{ {}, {} }}", scene::to_string(knob, knob.range->low),
                                scene::to_string(knob, knob.range->high));
        text += '\n';
    }
    return text;
}

Json definitions_of(const scene::Scene& scene) {
    Json definitions = Json::object();
    for (const glsl::NamedText& definition : glsl::definitions_of(scene))
        definitions[definition.name] = definition.text;
    return definitions;
}

std::string definition_lines(const scene::Scene& scene) {
    std::string text;
    for (const glsl::NamedText& definition : glsl::definitions_of(scene))
        if (!definition.text.empty())
            text += fmt::format("  define    {} = {}\n", definition.name, in_short(definition.text));
    return text;
}

Json what_files_say(const scene::Scene& scene) {
    Json json = {{"tidemark", k_version}, {"scene", scene.file.string()}, {"files", files_of(scene)}};
    json["passes"] = Json::array();
    for (const scene::Pass& pass : scene.passes) {
        Json channels = Json::object();
        for (size_t i = 0; i < pass.channels.size(); ++i)
            if (is_chosen(pass.channels[i]))
                channels[fmt::format("iChannel{}", i)] = describe(scene, pass.channels[i]);
        json["passes"].push_back({{"name", pass.name}, {"channels", channels}});
    }
    if (scene.size)
        json["size"] = {scene.size->width, scene.size->height};
    json["knobs"] = knobs_of(scene);
    json["definitions"] = definitions_of(scene);
    return json;
}

std::string lines_of_files(const scene::Scene& scene) {
    std::string text = scene.file.string() + '\n';
    for (const auto& file : scene.files)
        text += fmt::format("  file      {}\n", file.string());
    for (const scene::Pass& pass : scene.passes) {
        text += fmt::format("  pass      {}\n", pass.name);
        for (size_t i = 0; i < pass.channels.size(); ++i)
            if (is_chosen(pass.channels[i]))
                text += fmt::format("  iChannel{} {}\n", i, describe(scene, pass.channels[i]));
    }
    return text + knob_lines(scene) + definition_lines(scene);
}

} // namespace tidemark::cli
