#include "cli/check/check_trace.hpp"

#include "base/try.hpp"
#include "cli/check/trace_apart.hpp"
#include "cli/check/trace_text.hpp"
#include "cli/console.hpp"
#include "cli/diagnostics.hpp"
#include "cli/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
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
                           : "every pixel is finite; --hidden looks for a NaN that was masked on "
                             "the way\n";
    if (!run.ended.empty())
        text += fmt::format("  note: {}: the above is incomplete\n", run.ended);
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
        return fail(ErrorCode::usage, "--trace looks at one frame: give --frame N or --time T");
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

} // namespace tidemark::cli
