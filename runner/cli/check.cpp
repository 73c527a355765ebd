#include "cli/check.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/check_report.hpp"
#include "cli/commands.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "host/scene_report.hpp"
#include "host/supervision.hpp"
#include "render/gl_context.hpp"
#include "shader/portability.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>

namespace tidemark::cli {

using namespace host;
using host::resolve;
namespace {

Json json_of(const Diagnostic& diagnostic) {
    return {{"file", diagnostic.where.file},
            {"line", diagnostic.where.line},
            {"column", diagnostic.where.column},
            {"message", diagnostic.message}};
}

/// Returns a finding for each file of the scene that begins with a byte order mark. Loading removes it, but
/// it goes along if the text is pasted into the site.
std::vector<Diagnostic> byte_order_marks(const scene::Scene& scene) {
    constexpr std::string_view k_mark = "\xEF\xBB\xBF";
    std::vector<std::string> files{scene.common.lines().locate(1).file};
    for (const scene::Pass& pass : scene.passes)
        files.push_back(pass.text.lines().locate(1).file);
    std::vector<Diagnostic> found;
    for (const std::string& file : files) {
        const bool seen =
            std::ranges::any_of(found, [&](const Diagnostic& each) { return each.where.file == file; });
        const auto text = file.empty() || file.ends_with(".json") || seen ? fail(ErrorCode::load, "")
                                                                          : read_text_file(file);
        if (text && text->starts_with(k_mark))
            found.push_back({{file, 1, 1},
                             Severity::warning,
                             "the file begins with a byte order mark (U+FEFF): the site refuses it if it is "
                             "pasted too; save as UTF-8 without one"});
    }
    return found;
}

} // namespace

Result<int> check_portable(const SceneRequest& request, const host::DeviceChoice& device, bool as_json) {
    const auto scene = TRY(load(request));
    std::vector<Diagnostic> found = byte_order_marks(scene);
    std::ranges::move(glsl::portability_lint(scene), std::back_inserter(found));
    // A compiler of OpenGL ES is stricter than one of a desktop in a text of version 300 es.
    auto context = host::HeadlessContext::create({host::with_es(device.name), device.gpu_only});
    if (!context)
        context = host::HeadlessContext::create(device);
    std::optional<SlowNotice> notice;
    if (context)
        add_site_refusals(scene, found, [&](const std::string& pass) {
            notice.emplace("the driver is compiling " + pass);
        });
    else
        say("checked the texts only; could not compile them: " + to_string(context.error()));
    notice.reset();

    Json json = {{"tidemark", k_version},
                 {"scene", scene.file.string()},
                 {"portable", found.empty()},
                 {"compiled", context.has_value()},
                 {"compiler", context ? Json(gl::query_capabilities().version) : Json(nullptr)},
                 {"findings", Json::array()}};
    std::string text = found.empty() ? "nothing found\n" : "";
    for (const Diagnostic& diagnostic : found) {
        if (findings_are_diagnostics())
            say(finding_of(diagnostic, {"portable", "The texts compile on ShaderToy's site"}));
        else
            text += to_string(diagnostic) + '\n';
        json["findings"].push_back(json_of(diagnostic));
    }
    const int code = found.empty() ? 0 : exit_code(ErrorCode::check_failed);
    return put(as_json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

namespace {

/// Places the finding at the operation that produced the value; the message is the first line of the text.
Finding finding(const TraceFound& run, const scene::Scene& scene) {
    const SourceLocation where = origin_in(run.json).value_or(SourceLocation{scene.file.string()});
    return finding_of({where, Severity::error, run.text.substr(0, run.text.find('\n'))},
                      {"trace", "Every pixel is finite"});
}

Result<int> report(const TraceFound& run, const TraceOptions& options, const scene::Scene& scene) {
    Json json = {{"tidemark", k_version}, {"scene", scene.file.string()}, {"finite", !run.found}};
    json["trace"] = run.json;
    json["ended"] = run.ended;
    std::string text = run.found ? run.text
                       : options.hidden
                           ? "every pixel is finite, and no operation gave NaN\n"
                           : "every pixel is finite; --hidden searches for a NaN that was masked\n";
    if (!run.ended.empty())
        text += fmt::format("  note: this result is incomplete: {}\n", run.ended);
    if (findings_are_diagnostics()) {
        text.clear();
        if (run.found)
            say(finding(run, scene));
    }
    const int code = run.found ? exit_code(ErrorCode::check_failed) : 0;
    return put(options.json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

} // namespace

Result<int> check_trace(const TraceOptions& options) {
    const auto frames = TRY(resolve(sized(options.frames, options.scene)));
    if (frames.frames.size() != 1)
        return fail(ErrorCode::usage, "--trace works on one frame: give --frame N or --time T");
    if (!(options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    TraceJob job{options.device, {}};
    if (!options.pixel.empty()) {
        const auto pixel = TRY(parse_pixel(options.pixel, frames.state.extent));
        job.request.pixel = lab::PixelPlace{pixel.x, pixel.y};
    }
    const auto scene = TRY(load(options.scene, frames));
    job.request.frame = frames.frames.front();
    job.request.states = states_of(frames);
    job.request.hidden = options.hidden;
    const auto run = TRY(trace_apart(scene, job, options.timeout));
    return report(run, options, scene);
}

namespace {

struct CheckOptions {
    ProbesRequest probes;
    TraceOptions trace; ///< `scene`, `device` and `json` are copied from the probes' request
    bool portable = false;
    bool traced = false;
    bool mended = false;
    bool write = false;
    bool hashes = false;
    bool list = false;
};

/// Adds options that all need --trace, which must exist already.
void add_trace_options(Command command, TraceOptions& options) {
    const auto before = command.options();
    add_picture_options(command, options.frames);
    add_time_options(command, options.frames);
    command
        .add_option("--pixel", options.pixel,
                    "Pixel to trace, counted from the bottom left [the first non-finite one]")
        .type_name("X,Y");
    command.add_flag("--hidden", options.hidden,
                     "If all pixels are finite, traces a NaN that a clamp or a condition masked");
    command.add_option("--timeout", options.timeout, "Stops the trace after so many seconds")
        .type_name("SECONDS")
        .capture_default_str();
    for (const Option& option : command.options())
        if (std::ranges::find(before, option) == before.end())
            option.needs("--trace").group("With --trace");
}

Result<int> trace(const CheckOptions& options) {
    TraceOptions trace = options.trace;
    trace.scene = options.probes.scene;
    trace.device = options.probes.device;
    trace.json = options.probes.json;
    return check_trace(trace);
}

FixOptions fix_options(const CheckOptions& options) {
    const ProbesRequest& probes = options.probes;
    return {probes.scene, probes.device,  probes.budget, options.write,
            probes.json,  options.hashes, probes.output};
}

} // namespace

void add_check(Command app, Action& chosen) {
    auto options = std::make_shared<CheckOptions>();
    Command command =
        app.add_subcommand("check", "Checks whether a scene's numbers can be trusted, and shows where not");
    ProbesRequest& probes = options->probes;
    add_scene_options(command, probes.scene);
    command.add_option("--probe", probes.probes, "Runs only this probe; may be given several times [all]")
        .repeatable()
        .type_name("NAME");
    command
        .add_option("-o,--output", probes.output,
                    "Folder for a report: index.html and a picture of each failure and warning")
        .type_name("FOLDER");
    command
        .add_option("--budget", probes.budget,
                    "Seconds for all probes together; unfinished probes are cut off, with exit code 5")
        .type_name("S")
        .capture_default_str();
    add_device_options(command, probes.device);
    const Option list =
        command.add_flag("--list", options->list, "Lists the probes and what each looks at, then exits");
    command.option("SCENE").required(false);
    command
        .add_flag("--portable", options->portable,
                  "Instead of probing: lists what will not compile on ShaderToy's site")
        .excludes(list);
    command
        .add_flag("--trace", options->traced,
                  "Instead of probing: finds the origin of a NaN or infinity in the picture")
        .excludes(list)
        .excludes("--portable");
    const Option fix = command.add_flag("--fix", options->mended,
                                        "Instead of probing: prints fixes for non-finite, undefined and "
                                        "uninitialised values as diffs; each was drawn and measured");
    fix.excludes(list).excludes("--portable").excludes("--trace").excludes("--probe");
    command.add_flag("--write", options->write, "Writes the fixes into the scene's files").needs(fix);
    command
        .add_flag("--hashes", options->hashes,
                  "Also replaces hashes of large sines: the same numbers on every GPU, but another picture")
        .needs(fix);
    add_trace_options(command, options->trace);
    command.add_flag("--all", probes.all,
                     "Also prints notes, what each probe found, and why probes do not apply");
    command.add_flag("--json", probes.json, "Prints one JSON object");
    command.on_call([options, &chosen] {
        if (!options->list && options->probes.scene.path.empty())
            fail_for_missing("SCENE");
        chosen = [options]() -> Result<int> {
            Interrupt interrupt;
            if (!options->list && !options->portable && !options->traced && !options->mended)
                return check_probes(options->probes, interrupt);
            const Interrupt::Immediate at_once(interrupt); // answers printed so far remain
            return options->list ? list_probes()
                   : options->portable
                       ? check_portable(options->probes.scene, options->probes.device, options->probes.json)
                   : options->traced ? trace(*options)
                                     : check_fix(fix_options(*options));
        };
    });
}

} // namespace tidemark::cli
