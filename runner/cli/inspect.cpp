#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/inspect_savings.hpp"
#include "cli/omissions.hpp"
#include "cli/options.hpp"
#include "cli/precision_report.hpp"
#include "cli/version.hpp"
#include "gl/capabilities.hpp"
#include "glsl/pass_reading.hpp"
#include "platform/headless_context.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tidemark::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InspectOptions {
    SceneRequest scene;
    std::string device = "auto";
    std::string pass;
    std::string size = "640x360";
    std::vector<std::string> with;
    double budget = 20;
    bool devices = false;
    bool source = false;
    bool json = false;
};

std::string_view name_of(platform::DeviceKind kind) {
    switch (kind) {
    case platform::DeviceKind::hardware: return "hardware";
    case platform::DeviceKind::software: return "software";
    case platform::DeviceKind::unknown: return "unknown";
    }
    return "unknown";
}

Json to_json(const platform::HeadlessDevice& device) {
    Json json = {{"name", device.name}, {"kind", name_of(device.kind)}};
    if (device.reason.empty()) {
        json["renderer"] = device.renderer;
        json["version"] = device.version;
    } else {
        json["unusable"] = device.reason;
    }
    return json;
}

std::string to_line(const platform::HeadlessDevice& device) {
    if (!device.reason.empty())
        return fmt::format("{:<12} unusable: {}\n", device.name, device.reason);
    return fmt::format("{:<12} {}, {}, OpenGL {}\n", device.name, name_of(device.kind), device.renderer,
                       device.version);
}

Result<int> inspect_devices(bool as_json) {
    const auto devices = platform::list_headless_devices();
    std::string text;
    Json json = {{"tidemark", k_version}, {"devices", Json::array()}};
    for (const platform::HeadlessDevice& device : devices) {
        text += to_line(device);
        json["devices"].push_back(to_json(device));
    }
    return put(as_json ? json.dump(2) + "\n" : text).map([] { return 0; });
}

/// What a channel reads, in a word or by its file.
class Describer {
public:
    explicit Describer(const scene::Scene& scene) : scene_(scene) {}

    std::string operator()(const scene::Unbound&) const { return "none"; }
    std::string operator()(const scene::Noise&) const { return "noise"; }
    std::string operator()(const scene::Picture& picture) const { return picture.file.string(); }
    std::string operator()(const scene::PassOutput& output) const { return scene_.passes[output.pass].name; }
    std::string operator()(const scene::Cubemap& cubemap) const { return cubemap.files.front().string(); }
    std::string operator()(const scene::Volume& volume) const { return volume.file.string(); }
    std::string operator()(const scene::Keyboard&) const { return "keyboard"; }
    std::string operator()(const scene::Music& music) const {
        return music.file.empty() ? "silent signal" : music.file.string();
    }
    std::string operator()(const scene::Video& video) const { return video.file.string(); }
    std::string operator()(const scene::StandIn&) const { return "stand-in"; }
    std::string operator()(const scene::Constant&) const { return "one value"; }

private:
    const scene::Scene& scene_;
};

std::string describe(const scene::Scene& scene, const scene::Channel& channel) {
    return std::visit(Describer(scene), channel.input);
}

std::vector<double> components_of(const scene::Knob& knob, const scene::KnobValue& value) {
    return {value.begin(), value.begin() + scene::info(knob.type).components};
}

Json to_json(const scene::Knob& knob) {
    Json json = {{"name", knob.name},
                 {"type", scene::info(knob.type).directive_name},
                 {"value", components_of(knob, knob.value)}};
    if (knob.range) {
        json["low"] = components_of(knob, knob.range->low);
        json["high"] = components_of(knob, knob.range->high);
    }
    return json;
}

Json to_json(const render::Renderer& renderer, const gl::Capabilities& driver) {
    const SceneFacts facts = facts_of(renderer);
    const scene::Scene& scene = renderer.scene();
    Json json;
    json["tidemark"] = k_version;
    json["scene"] = scene.file.string();
    json["driver"] = driver.version;
    json["renderer"] = driver.renderer;
    json["files"] = Json::array();
    for (const auto& file : scene.files)
        json["files"].push_back(file.string());
    json["uniforms"] = facts.uniforms;
    json["passes"] = Json::array();
    for (const PassFacts& facts_of_pass : facts.passes) {
        const scene::Pass& pass = scene.passes[facts_of_pass.pass];
        Json channels = Json::object();
        for (const int channel : facts_of_pass.channels)
            channels[fmt::format("iChannel{}", channel)] = describe(scene, pass.channels[size_t(channel)]);
        json["passes"].push_back({{"name", pass.name}, {"channels", channels}});
    }
    json["knobs"] = Json::array();
    for (const scene::Knob& knob : scene.knobs)
        json["knobs"].push_back(to_json(knob));
    add_precision(json, renderer);
    json["left_out"] = facts.left_out;
    return json;
}

std::string to_text(const render::Renderer& renderer, const gl::Capabilities& driver) {
    const SceneFacts facts = facts_of(renderer);
    const scene::Scene& scene = renderer.scene();
    std::string text =
        fmt::format("{}\n  driver    {}, OpenGL {}\n", scene.file.string(), driver.renderer, driver.version);
    text += fmt::format("  uniforms  {}\n", fmt::join(facts.uniforms, ", "));
    for (const PassFacts& facts_of_pass : facts.passes) {
        const scene::Pass& pass = scene.passes[facts_of_pass.pass];
        if (scene.passes.size() > 1)
            text += fmt::format("  pass      {}\n", pass.name);
        for (const int channel : facts_of_pass.channels)
            text +=
                fmt::format("  iChannel{} {}\n", channel, describe(scene, pass.channels[size_t(channel)]));
    }
    for (const scene::Knob& knob : scene.knobs) {
        text += fmt::format("  knob      {} {} = {}", scene::info(knob.type).directive_name, knob.name,
                            scene::to_string(knob));
        if (knob.range)
            text += fmt::format(" in {{ {}, {} }}", scene::to_string(knob, knob.range->low),
                                scene::to_string(knob, knob.range->high));
        text += '\n';
    }
    text += precision_lines(renderer);
    for (const std::string& thing : facts.left_out)
        text += fmt::format("  left out  {}\n", thing);
    return text;
}

/// The text of a pass, Image when none is named.
Result<int> put_source(const scene::Scene& scene, const std::string& name, glsl::Precision precision) {
    for (const scene::Pass& pass : scene.passes) {
        if (pass.name != name && !(name.empty() && pass.kind == scene::PassKind::image))
            continue;
        const glsl::PassReading reading(scene, pass);
        const auto assembly = reading.assemble(reading.dialects(precision).front());
        if (!assembly)
            return fail(assembly.error());
        return put(assembly->source.text()).map([] { return 0; });
    }
    return fail(ErrorCode::usage, fmt::format("--pass {}: the scene has no such pass", name));
}

Result<int> inspect_scene(const InspectOptions& options) {
    auto scene = load(options.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    if (options.source)
        return put_source(*scene, options.pass, precision_of(options.scene));
    const auto context = platform::HeadlessContext::create(options.device);
    if (!context)
        return fail(context.error());
    render::RenderOptions target;
    target.pass = options.pass;
    target.precision = precision_of(options.scene);
    const auto renderer = render::Renderer::create(*std::move(scene), target);
    if (!renderer)
        return fail(renderer.error());
    const gl::Capabilities driver = gl::query_capabilities();
    return put(options.json ? to_json(*renderer, driver).dump(2) + "\n" : to_text(*renderer, driver)).map([] {
        return 0;
    });
}

} // namespace

void add_inspect(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command = app.add_subcommand("inspect", "Tells what a scene needs and what was left out");
    add_scene_options(*command, options->scene);
    command->get_option("SCENE")->required(false);
    add_precision_options(*command, options->scene);
    command->add_option("--device", options->device, "Where to draw: a name from --devices")
        ->type_name("NAME")
        ->capture_default_str();
    command->add_option("--pass", options->pass, "The pass to look at, as in \"Buffer A\" [Image]")
        ->type_name("NAME");
    command->add_flag("--devices", options->devices, "Lists where OpenGL contexts can be had, and no scene");
    command->add_flag("--source", options->source,
                      "Prints the text that the driver compiles, and nothing else");
    const auto things = things_left_out();
    command
        ->add_option("--with", options->with,
                     fmt::format("Puts back what was left out and measures what that costs: {}",
                                 fmt::join(things, ", ")))
        ->type_name("THING[,…]")
        ->delimiter(',')
        ->check(CLI::IsMember(things));
    command->add_option("--size", options->size, "With --with: the picture's size")
        ->type_name("WxH")
        ->capture_default_str();
    command->add_option("--budget", options->budget, "With --with: seconds to measure for")
        ->type_name("S")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_flag("--json", options->json, "One JSON object on standard output");
    command->callback([options, &chosen] {
        chosen = [options]() -> Result<int> {
            if (options->devices)
                return inspect_devices(options->json);
            if (options->scene.path.empty())
                return fail(ErrorCode::usage, "inspect: give a SCENE, or --devices");
            if (!options->with.empty())
                return inspect_savings({options->scene, options->size, options->pass, options->device,
                                        options->with, options->budget, options->json});
            return inspect_scene(*options);
        };
    });
}

} // namespace tidemark::cli
