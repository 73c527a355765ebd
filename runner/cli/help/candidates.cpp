#include "cli/help/candidates.hpp"

#include "cli/commands.hpp"
#include "glsl/overrides.hpp"
#include "lab/check/probe.hpp"
#include "platform/headless_context.hpp"
#include "scene/load_scene.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

namespace tidemark::cli {
namespace {

using Words = std::vector<std::string>;

/// Returns the innermost command named in `before`.
const CLI::App& command_of(const CLI::App& app, const Words& before) {
    const CLI::App* command = &app;
    for (const std::string& word : before)
        for (const CLI::App* inner : command->get_subcommands({}))
            if (inner->get_name() == word) {
                command = inner;
                break;
            }
    if (command == &app && !before.empty() && !before.front().starts_with('-'))
        return *app.get_subcommand("view"); // `tidemark SCENE` is short for `tidemark view SCENE`
    return *command;
}

Words commands_and_options(const CLI::App& command) {
    Words names;
    for (const CLI::App* inner : command.get_subcommands({}))
        names.push_back(inner->get_name());
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
        for (const std::string& name : option->get_snames())
            names.push_back("-" + name);
    }
    return names;
}

/// Returns the knobs, or the names for --define, of the first argument that is a scene.
Words names_in_scene(const Words& before, bool knobs) {
    Words names;
    for (const std::string& word : before) {
        std::error_code ignored;
        if (!std::filesystem::exists(word, ignored))
            continue;
        const auto scene = scene::load_scene(word);
        if (!scene)
            continue;
        if (knobs)
            for (const scene::Knob& knob : scene->knobs)
                names.push_back(knob.name + "=");
        else
            for (const glsl::NamedText& definition : glsl::definitions_of(*scene))
                names.push_back(definition.name + "=");
        break;
    }
    return names;
}

Words probe_names() {
    Words names;
    for (const lab::Probe& probe : lab::all_probes())
        names.emplace_back(probe.name);
    return names;
}

Words device_names() {
    Words names = {"auto"};
    for (const platform::HeadlessDevice& device : platform::list_headless_devices())
        names.push_back(device.name);
    return names;
}

/// Splits choices such as `single|double`; returns nothing for other forms, such as
/// `[PASS:]N=FILE|noise|none`.
Words choices(const std::string& type) {
    const bool plain = std::all_of(type.begin(), type.end(), [](unsigned char c) {
        return c == '|' || std::islower(c) || std::isdigit(c);
    });
    return plain && type.find('|') != type.npos ? CLI::detail::split(type, '|') : Words{};
}

Words values_of(const CLI::Option& option, const Words& before) {
    if (option.check_lname("set") || option.check_lname("define"))
        return names_in_scene(before, option.check_lname("set"));
    if (option.check_lname("probe"))
        return probe_names();
    if (option.check_lname("device"))
        return device_names();
    return choices(option.get_type_name());
}

} // namespace

Words candidates(const CLI::App& app, const Words& words) {
    if (words.empty())
        return {};
    const Words before(words.begin(), words.end() - 1);
    const CLI::App& command = command_of(app, before);
    const CLI::Option* option = !before.empty() && before.back().starts_with('-')
                                    ? command.get_option_no_throw(before.back())
                                    : nullptr;
    const bool wants_value = option && option->get_items_expected_max() > 0;
    Words found = wants_value ? values_of(*option, before) : commands_and_options(command);
    if (!wants_value && command.get_name() == "help")
        std::ranges::copy(help_topics(), std::back_inserter(found));
    std::erase_if(found, [&](const std::string& word) { return !word.starts_with(words.back()); });
    return found;
}

} // namespace tidemark::cli
