#include "cli/check/check_trace.hpp"

#include "base/try.hpp"
#include "cli/check/trace_apart.hpp"
#include "cli/console.hpp"
#include "cli/version.hpp"

#include <fmt/format.h>

#include <charconv>

namespace tidemark::cli {
namespace {

Result<std::optional<lab::PixelPlace>> parse_pixel(const std::string& text, Extent extent) {
    if (text.empty())
        return std::nullopt;
    lab::PixelPlace pixel;
    const char* const end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, pixel.x);
    if (x.ec == std::errc{} && x.ptr != end && *x.ptr == ',') {
        const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
        if (y.ec == std::errc{} && y.ptr == end && pixel.x >= 0 && pixel.y >= 0 && pixel.x < extent.width &&
            pixel.y < extent.height)
            return pixel;
    }
    return fail(ErrorCode::usage, fmt::format("--pixel {}: give x,y from the bottom left, within {}x{}", text,
                                              extent.width, extent.height));
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
    const int code = run.found ? exit_code(ErrorCode::check_failed) : 0;
    return put(options.json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

} // namespace

Result<int> check_trace(const TraceOptions& options) {
    const auto frames = TRY(resolve(options.frames));
    if (frames.frames.size() != 1)
        return fail(ErrorCode::usage, "--trace looks at one frame: give --frame N or --time T");
    if (!(options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    const auto pixel = TRY(parse_pixel(options.pixel, frames.state.extent));
    const auto scene = TRY(load(options.scene));
    TraceJob job{options.device, {}};
    job.request.frame = frames.frames.front();
    job.request.states = states_of(frames);
    job.request.pixel = pixel;
    job.request.hidden = options.hidden;
    const auto run = TRY(trace_apart(scene, job, options.timeout));
    return report(run, options, scene);
}

} // namespace tidemark::cli
