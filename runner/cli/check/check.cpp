#include "cli/check/check_fix.hpp"
#include "cli/check/check_portable.hpp"
#include "cli/check/check_probes.hpp"
#include "cli/check/check_trace.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"

#include <algorithm>
#include <memory>

namespace tidemark::cli {
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
        .add_option("--pixel", options.pixel, "The pixel to trace, from the bottom left [the first bad one]")
        .type_name("X,Y");
    command.add_flag("--hidden", options.hidden,
                     "Where all pixels are finite, trace a NaN that a clamp or a condition masked");
    command.add_option("--timeout", options.timeout, "Give up the trace after so long")
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
        app.add_subcommand("check", "Tells whether a scene's numbers can be trusted, and where not");
    ProbesRequest& probes = options->probes;
    add_scene_options(command, probes.scene);
    command.add_option("--probe", probes.probes, "Only this probe; may be given again [all]")
        .repeatable()
        .type_name("NAME");
    command
        .add_option("-o,--output", probes.output,
                    "Folder for index.html, and a picture of each failure and warning")
        .type_name("FOLDER");
    command
        .add_option("--budget", probes.budget,
                    "Seconds for all of it: what has not answered by then is cut, and is exit 5")
        .type_name("S")
        .capture_default_str();
    add_device_options(command, probes.device);
    const Option list =
        command.add_flag("--list", options->list, "What each probe looks at, and nothing else");
    command.option("SCENE").required(false);
    command
        .add_flag("--portable", options->portable, "Instead: what will not compile on ShaderToy's own site")
        .excludes(list);
    command
        .add_flag("--trace", options->traced,
                  "Instead: where a NaN or an infinity in the picture has its origin")
        .excludes(list)
        .excludes("--portable");
    const Option fix =
        command.add_flag("--fix", options->mended,
                         "Instead: cures of what is not finite, undefined or without a value, each "
                         "drawn before it is offered, as a diff");
    fix.excludes(list).excludes("--portable").excludes("--trace").excludes("--probe");
    command.add_flag("--write", options->write, "Writes the cures into the scene's files, one by one")
        .needs(fix);
    command
        .add_flag("--hashes", options->hashes,
                  "Hashes of large sines, too: the same numbers on every GPU, and another picture")
        .needs(fix);
    add_trace_options(command, options->trace);
    command.add_flag("--json", probes.json, "One JSON object on standard output");
    command.on_call([options, &chosen] {
        if (!options->list && options->probes.scene.path.empty())
            fail_for_missing("SCENE");
        chosen = [options]() -> Result<int> {
            Interrupt interrupt;
            const Interrupt::Immediate at_once(interrupt); // answers printed so far remain
            return options->list ? list_probes()
                   : options->portable
                       ? check_portable(options->probes.scene, options->probes.device, options->probes.json)
                   : options->traced ? trace(*options)
                   : options->mended ? check_fix(fix_options(*options))
                                     : check_probes(options->probes);
        };
    });
}

} // namespace tidemark::cli
