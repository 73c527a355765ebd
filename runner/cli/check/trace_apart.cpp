#include "cli/check/trace_apart.hpp"

#include "cli/check/trace_text.hpp"
#include "cli/forked.hpp"
#include "cli/supervisor.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

Json told(const lab::NanTrace& trace) {
    return {{"text", to_text(trace)}, {"trace", to_json(trace)}};
}

/// In the child.
Result<std::optional<lab::NanTrace>> trace(const scene::Scene& scene, const TraceJob& job, const Tell& tell) {
    const auto context = platform::HeadlessContext::create(job.device);
    if (!context)
        return fail(context.error());
    auto renderer = render::Renderer::create(scene, {job.extent, image::SampleType::f32, job.pass});
    if (!renderer)
        return fail(std::move(renderer.error()));
    lab::TraceRequest request = job.request;
    request.progress = [&](const lab::NanTrace& found) { tell(dump(told(found))); };
    return lab::trace_nan(*renderer, request);
}

Json last_line(const std::string& output) {
    if (output.empty())
        return {};
    const size_t begin = output.rfind('\n', output.size() - 2);
    return Json::parse(output.substr(begin == output.npos ? 0 : begin + 1), nullptr, false);
}

} // namespace

Result<TraceFound> trace_apart(const scene::Scene& scene, const TraceJob& job, double seconds) {
    const auto run = run_forked(
        [&](const Tell& tell) {
            const auto found = trace(scene, job, tell);
            if (!found)
                tell(dump(told(found.error())));
            else
                tell(dump(*found ? told(**found) : Json{{"finite", true}}));
        },
        seconds);
    if (!run)
        return fail(run.error());
    const Json line = last_line(run->output);
    if (auto error = told_error(line))
        return fail(*std::move(error));
    TraceFound result;
    result.found = line.contains("trace");
    result.ended = run->timed_out     ? fmt::format("gave up after {:.3g} s", seconds)
                   : run->signal != 0 ? crash_text(run->signal, run->doing)
                                      : "";
    if (!result.ended.empty() && !result.found)
        return fail(run->timed_out ? ErrorCode::timed_out : ErrorCode::load,
                    fmt::format("'{}': {}", scene.file.string(), result.ended));
    if (result.found) {
        result.text = line.at("text").get<std::string>();
        result.json = line.at("trace");
    }
    return result;
}

} // namespace tidemark::cli
