#include "cli/inspect.hpp"

#include "base/folders.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/scene_report.hpp"
#include "lab/lens.hpp"
#include "lab/pass_function.hpp"
#include "lab/probe_inputs.hpp"
#include "render/compiled_scene.hpp"
#include "render/gl_context.hpp"
#include "scene/scene.hpp"
#include "shader/driver_log.hpp"
#include "shader/pass_reading.hpp"
#include "shader/shader_source.hpp"
#include "shader/specialise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>

namespace tidemark::cli {

using namespace host;
using host::files_of;
namespace {

/// The size of a compiled pass, in bytes of the driver's own program format and in instructions if its
/// compiler reports them.
struct DriverCode {
    size_t bytes = 0; ///< 0: the driver has no program binaries
    std::vector<glsl::InstructionCount> instructions{};
};

/// The sizes of one pass, for each value of glsl::Specialise.
using CompiledSizes = std::array<DriverCode, 4>;

/// Gives the driver an empty shader cache, so that it compiles: from its cache it would report no counts.
/// Construct it before the process has a context.
class FreshDriverCache {
public:
    FreshDriverCache() {
        if (folder_.path().empty())
            return;
        ::setenv("MESA_SHADER_CACHE_DIR", folder_.path().c_str(), 1);
        host::do_without_full_driver_cache();
    }

private:
    ScratchFolder folder_;
};

/// Returns one line for each loop; empty if the pass has none or cannot be analysed.
std::string march_lines(const scene::Scene& scene, const scene::Pass& pass) {
    const auto function = lab::PassFunction::create(scene, pass);
    std::string text;
    if (!function)
        return text;
    for (const proof::MarchingLoop& loop : function->loops()) {
        const SourceLocation where = function->locate(loop.line);
        text += fmt::format("  march     {}:{}: {}; ends here near the surface\n", where.file, where.line,
                            loop.kind == proof::MarchingLoop::Kind::sphere_tracing
                                ? "steps by the distance (sphere tracing)"
                                : "steps that do not depend on the distance");
    }
    return text;
}

/// Returns [{"file", "line", "kind"}], or {"not_followed": reason}.
Json marches_of(const scene::Scene& scene, const scene::Pass& pass) {
    const auto function = lab::PassFunction::create(scene, pass);
    if (!function)
        return {{"not_followed", function.error().message}};
    Json loops = Json::array();
    for (const proof::MarchingLoop& loop : function->loops()) {
        const SourceLocation where = function->locate(loop.line);
        loops.push_back({{"file", where.file},
                         {"line", where.line},
                         {"kind", loop.kind == proof::MarchingLoop::Kind::sphere_tracing ? "sphere tracing"
                                                                                         : "fixed step"}});
    }
    return loops;
}

using glsl::Specialise;

const DriverCode& of(const CompiledSizes& sizes, Specialise how) {
    return sizes[size_t(how)];
}

/// The program is deleted on return: a driver that still has an equal one would not compile the next.
std::optional<DriverCode> code_of(const scene::Scene& scene, const scene::Pass& pass,
                                  glsl::Precision precision, Specialise how) {
    gl::CompilerMessages messages;
    const auto linked = render::link_pass(scene, pass, {precision, how});
    if (!linked)
        return std::nullopt;
    DriverCode code{linked->program.binary().bytes.size()};
    for (const std::string& message : messages.take())
        if (auto count = glsl::read_instruction_count(message))
            code.instructions.push_back(*std::move(count));
    return code;
}

std::optional<CompiledSizes> sizes_of(const scene::Scene& scene, const scene::Pass& pass,
                                      glsl::Precision precision) {
    CompiledSizes sizes;
    for (size_t i = 0; i < sizes.size(); ++i) {
        auto code = code_of(scene, pass, precision, Specialise(i));
        if (!code)
            return std::nullopt;
        // A driver that reported counts before and reports none now reuses code that it compiled before.
        if (code->instructions.empty() && i > 0)
            code->instructions = sizes[i - 1].instructions;
        sizes[i] = *std::move(code);
    }
    return sizes;
}

Json code_json(const DriverCode& code) {
    Json instructions = Json::object();
    for (const auto& [shader, count] : code.instructions)
        instructions[shader] = count;
    return {{"bytes", code.bytes ? Json(code.bytes) : Json()}, {"instructions", instructions}};
}

std::string counts_of(const DriverCode& code) {
    std::vector<std::string> counts;
    for (const auto& [shader, count] : code.instructions)
        counts.push_back(fmt::format("{} {}", shader, count));
    return fmt::format("{}", fmt::join(counts, ", "));
}

std::string bytes_of(const DriverCode& code) {
    return fmt::format("{}", code.bytes);
}

/// Formats one figure of the four levels as a line.
std::string to_line(std::string_view what, const CompiledSizes& sizes,
                    std::string (*figure)(const DriverCode&)) {
    return fmt::format(
        "  {}: {}; without optimisation {}, in a long sequence {}, with constant knobs {}\n", what,
        figure(of(sizes, Specialise::unreachable)), figure(of(sizes, Specialise::nothing)),
        figure(of(sizes, Specialise::invariant_uniforms)), figure(of(sizes, Specialise::constants)));
}

/// Returns the sizes of each pass of the scene; nothing for a pass that does not link. A context must be
/// current.
std::vector<std::optional<CompiledSizes>> compiled_sizes(const scene::Scene& scene,
                                                         glsl::Precision precision) {
    std::vector<std::optional<CompiledSizes>> sizes;
    for (const scene::Pass& pass : scene.passes)
        sizes.push_back(pass.kind == scene::PassKind::sound ? std::nullopt
                                                            : sizes_of(scene, pass, precision));
    return sizes;
}

std::string to_lines(const CompiledSizes& sizes) {
    std::string text;
    if (sizes.front().bytes > 0)
        text += to_line("program bytes", sizes, bytes_of);
    if (!sizes.front().instructions.empty())
        text += to_line("instructions", sizes, counts_of);
    return text;
}

Json sizes_json(const CompiledSizes& sizes) {
    return {{"plain", code_json(of(sizes, Specialise::nothing))},
            {"specialised", code_json(of(sizes, Specialise::unreachable))},
            {"long_sequence", code_json(of(sizes, Specialise::invariant_uniforms))},
            {"constant_knobs", code_json(of(sizes, Specialise::constants))}};
}

struct InspectOptions {
    SceneRequest scene;
    host::DeviceChoice device{};
    std::string pass;
    std::string size = "640x360";
    std::vector<std::string> with;
    double budget = 20;
    bool hot_lines = false;
    double time = 10;
    bool devices = false;
    bool self_test = false;
    bool source = false;
    bool specialised = false;
    bool json = false;
};

Json json_of(const glsl::LeftOut& left_out) {
    Json json = {{"lines", left_out.lines}, {"out_of_loops", left_out.loop_invariants}};
    if (!left_out.anything())
        json["none_because"] = left_out.kept_whole;
    return json;
}

std::string to_line(const glsl::LeftOut& left_out) {
    if (!left_out.anything())
        return fmt::format("  code removed: none, because {}\n", left_out.kept_whole);
    std::string text = fmt::format("  code removed: {} lines", left_out.lines);
    if (left_out.in_doubt())
        text += fmt::format("; in a long sequence also {} expressions moved out of loops",
                            left_out.loop_invariants);
    return text + '\n';
}

/// One entry per pass.
using Sizes = std::vector<std::optional<CompiledSizes>>;

Json json_of(const render::Renderer& renderer, const gl::Capabilities& driver, const Sizes& sizes) {
    const SceneFacts facts = facts_of(renderer);
    const scene::Scene& scene = renderer.scene();
    Json json;
    json["tidemark"] = k_version;
    json["scene"] = scene.file.string();
    json["driver"] = driver.version;
    json["renderer"] = driver.renderer;
    json["files"] = files_of(scene);
    json["uniforms"] = facts.uniforms;
    for (const auto& [name, value] : facts.other_names)
        json["other_hosts_names"][name] = value;
    json["passes"] = Json::array();
    for (const PassFacts& facts_of_pass : facts.passes) {
        const scene::Pass& pass = scene.passes[facts_of_pass.pass];
        Json channels = Json::object();
        for (const int channel : facts_of_pass.channels)
            channels[fmt::format("iChannel{}", channel)] = describe(scene, pass.channels[size_t(channel)]);
        Json& json_of_pass = json["passes"].emplace_back(
            Json{{"name", pass.name},
                 {"channels", channels},
                 {"code_removed",
                  json_of(left_out_of(renderer, facts_of_pass.pass, glsl::Specialise::invariant_uniforms))},
                 {"marches", marches_of(scene, pass)}});
        if (const auto& size = sizes[facts_of_pass.pass])
            json_of_pass["program"] = sizes_json(*size);
    }
    if (scene.size)
        json["size"] = {scene.size->width, scene.size->height};
    json["sounds"] = sounds_of(scene);
    json["knobs"] = knobs_of(scene);
    json["definitions"] = definitions_of(scene);
    add_precision(json, renderer);
    json["left_out"] = facts.left_out;
    return json;
}

std::string to_text(const render::Renderer& renderer, const gl::Capabilities& driver, const Sizes& sizes) {
    const SceneFacts facts = facts_of(renderer);
    const scene::Scene& scene = renderer.scene();
    std::string text =
        fmt::format("{}\n  driver    {}, OpenGL {}\n", scene.file.string(), driver.renderer, driver.version);
    text += fmt::format("  uniforms  {}\n", fmt::join(facts.uniforms, ", "));
    for (const auto& [name, value] : facts.other_names)
        text += fmt::format("            {}: another host's name for {}\n", name, value);
    for (const PassFacts& facts_of_pass : facts.passes) {
        const scene::Pass& pass = scene.passes[facts_of_pass.pass];
        if (scene.passes.size() > 1)
            text += fmt::format("  pass      {}\n", pass.name);
        for (const int channel : facts_of_pass.channels)
            text +=
                fmt::format("  iChannel{} {}\n", channel, describe(scene, pass.channels[size_t(channel)]));
        text += to_line(left_out_of(renderer, facts_of_pass.pass, glsl::Specialise::invariant_uniforms));
        text += march_lines(scene, pass);
        if (const auto& size = sizes[facts_of_pass.pass])
            text += to_lines(*size);
    }
    text += sound_lines(scene) + knob_lines(scene) + definition_lines(scene);
    text += precision_lines(renderer);
    for (const std::string& thing : facts.left_out)
        text += fmt::format("  left out  {}\n", thing);
    return text;
}

/// Prints the text of a pass, Image if no name is given.
Result<int> put_source(const scene::Scene& scene, const std::string& name, glsl::Precision precision,
                       glsl::Specialise how) {
    for (const scene::Pass& pass : scene.passes) {
        if (pass.name != name && !(name.empty() && pass.kind == scene::PassKind::image))
            continue;
        const glsl::PassReading reading(scene, pass);
        const auto assembly = TRY(reading.assemble(reading.dialects(precision).front()));
        return put_exact(glsl::specialise(assembly.source, scene.knobs, how).source.text()).map([] {
            return 0;
        });
    }
    return fail(ErrorCode::usage, fmt::format("--pass {}: the scene has no such pass", name));
}

Result<int> inspect_scene(const InspectOptions& options) {
    auto scene = TRY(load(options.scene));
    if (options.source)
        return put_source(scene, options.pass, precision_of(options.scene),
                          options.specialised ? glsl::Specialise::invariant_uniforms
                                              : glsl::Specialise::nothing);
    if (options.device.name == "none")
        return put(options.json ? dump(what_files_say(scene), 2) + "\n" : lines_of_files(scene)).map([] {
            return 0;
        });
    // Static, so that the folder goes after Mesa's threads, which end with the process and write to it until
    // then.
    static const FreshDriverCache fresh;
    const auto context = TRY(host::HeadlessContext::create(options.device, host::DebugContext::yes));
    render::RenderOptions target;
    target.pass = options.pass;
    target.precision = precision_of(options.scene);
    target.specialise = glsl::Specialise::unreachable;
    const Sizes sizes = compiled_sizes(scene, target.precision); // before the driver has compiled any of it
    const auto renderer = TRY(render::Renderer::create(std::move(scene), target));
    const gl::Capabilities driver = gl::query_capabilities();
    return put(options.json ? dump(json_of(renderer, driver, sizes), 2) + "\n"
                            : to_text(renderer, driver, sizes))
        .map([] { return 0; });
}

constexpr size_t k_hot_lines = 10;

std::string_view basis_of(const lab::HotLine& line) {
    return to_string(line.interval ? lab::Basis::measured : lab::Basis::counted);
}

Json json_of(const lab::HotLines& hot, const scene::Scene& scene, const render::FrameState& state) {
    Json json{{"tidemark", k_version},
              {"scene", scene.file.string()},
              {"size", {state.extent.width, state.extent.height}},
              {"time", state.seconds()},
              {"operations", hot.operations},
              {"weights", hot.basis},
              {"not_counted", hot.not_counted},
              {"lines", Json::array()}};
    for (const lab::HotLine& line : hot.lines)
        json["lines"].push_back(
            {{"file", line.where.file},
             {"line", line.where.line},
             {"share", line.share},
             {"basis", basis_of(line)},
             {"interval", line.interval ? Json{line.interval->low, line.interval->high} : Json()},
             {"counted", line.counted},
             {"text", line.text}});
    return json;
}

std::string interval_words(const lab::HotLine& line) {
    return line.interval
               ? fmt::format("{:.1f} to {:.1f}", 100 * line.interval->low, 100 * line.interval->high)
               : "counted";
}

std::string to_text(const lab::HotLines& hot, const scene::Scene& scene, const render::FrameState& state) {
    std::string text =
        fmt::format("{}, {}x{} at {:g} s: {:.0f} weighted operations per pixel, {}\n", scene.file.string(),
                    state.extent.width, state.extent.height, state.seconds(), hot.operations, hot.basis);
    if (hot.measured)
        text += "  share of the time, measured by doing the line twice, with its 95 % interval; counted: the "
                "line cannot be done twice, its share is that of the operations\n";
    for (const lab::HotLine& line : hot.lines)
        text += fmt::format("  {:>6}  {}{}:{}: {}\n", lab::share_words(line.share),
                            hot.measured ? fmt::format("{:<14}", interval_words(line)) : "", line.where.file,
                            line.where.line, line.text);
    for (const std::string& pass : hot.not_counted)
        text += fmt::format("  not counted: {}\n", pass);
    return text;
}

/// Prints the most expensive lines; with --diagnostics also as notes.
Result<int> put_hot_lines(const InspectOptions& options) {
    auto scene = TRY(load(options.scene));
    const auto extent = scene::size_of_text(options.size);
    if (!extent)
        return fail(ErrorCode::usage,
                    fmt::format("--size {}: give width and height, as in 640x360", options.size));
    const auto context = TRY(host::HeadlessContext::create(options.device));
    render::FrameState state = lab::state_at(options.time, *extent);
    state.pass = options.pass;
    const lab::HotLines hot =
        TRY(lab::hot_lines(scene, state, k_hot_lines, lab::device_weights(), options.budget));
    TRY(gl::check_work("counting the operations of lines"));
    if (findings_are_diagnostics())
        for (const lab::HotLine& line : hot.lines)
            say(finding_of({line.where, Severity::note,
                            fmt::format("{} of the {} of a frame, {}", lab::share_words(line.share),
                                        line.interval ? "time" : "work", basis_of(line))},
                           {"hot-line", "The lines of a text that take most of a frame."}));
    return put(options.json ? dump(json_of(hot, scene, state), 2) + "\n" : to_text(hot, scene, state))
        .map([] { return 0; });
}

} // namespace

void add_inspect(Command app, Action& chosen) {
    auto options = std::make_shared<InspectOptions>();
    Command command = app.add_subcommand("inspect", "Shows what a scene needs and what was left out");
    add_scene_options(command, options->scene);
    command.option("SCENE").required(false);
    add_precision_options(command, options->scene);
    add_device_options(command, options->device);
    command.option("--device")
        .description(
            "Device to draw with, or to list with --devices: a name from --devices; none: uses no driver "
            "and reports only what the files say");
    command.add_option("--pass", options->pass, "Pass to inspect, as in \"Buffer A\" [Image]")
        .type_name("NAME");
    const Option devices = command.add_flag("--devices", options->devices,
                                            "Lists the devices that offer an OpenGL context; needs no SCENE");
    command
        .add_flag("--self-test", options->self_test,
                  "With --devices: tests each device and prints one verdict per line")
        .needs(devices);
    command.add_flag("--source", options->source, "Prints only the text that the driver compiles");
    const auto things = things_left_out();
    command
        .add_option("--with", options->with,
                    fmt::format("Measures what leaving something out saves: {}", fmt::join(things, ", ")))
        .type_name("THING[,…]")
        .delimiter(',')
        .one_word()
        .check(one_of(things));
    command.add_flag("--hot-lines", options->hot_lines,
                     "Lists the ten lines that take most of a frame, measured by doing each twice");
    command.add_option("--time", options->time, "With --hot-lines: the moment")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds"))
        .capture_default_str();
    command.add_option("--size", options->size, "With --with and --hot-lines: size of the picture")
        .type_name("WxH")
        .capture_default_str();
    command
        .add_option("--budget", options->budget,
                    "With --with and --hot-lines: seconds to spend on measuring; 0: --hot-lines counts only")
        .type_name("S")
        .check(number<double>("a number of seconds from 0", 0))
        .capture_default_str();
    command
        .add_flag("--specialised", options->specialised,
                  "With --source: the optimised text that a long sequence is drawn with")
        .needs("--source");
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] {
        chosen = [options]() -> Result<int> {
            if (options->devices)
                return inspect_devices(options->device.name, options->self_test, options->json);
            if (options->scene.path.empty())
                return fail(ErrorCode::usage, "inspect: give a SCENE, or --devices");
            if (options->hot_lines)
                return put_hot_lines(*options);
            if (!options->with.empty() && options->budget == 0)
                return fail(ErrorCode::usage, "--budget 0: --with needs time to measure");
            if (!options->with.empty())
                return inspect_savings({options->scene, options->size, options->pass, options->device,
                                        options->with, options->budget, options->json});
            return inspect_scene(*options);
        };
    });
}

} // namespace tidemark::cli
