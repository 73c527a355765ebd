#include "cli/check/trace_apart.hpp"

#include "base/try.hpp"
#include "cli/check/trace_text.hpp"
#include "cli/forked.hpp"
#include "cli/json_dump.hpp"
#include "gl/reset.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <string_view>

namespace tidemark::cli {
namespace {

constexpr std::chrono::milliseconds k_between_frames_sent(200);

Json message_of(const lab::NanTrace& trace) {
    return {{"text", to_text(trace)}, {"trace", to_json(trace)}};
}

/// Runs in the child.
Result<std::optional<lab::NanTrace>> trace(const scene::Scene& scene, const TraceJob& job, const Tell& tell) {
    const auto context = TRY(platform::HeadlessContext::create(job.device));
    const render::FrameState state = job.request.states(job.request.frame);
    auto renderer = TRY(render::Renderer::create(scene, {state.extent, image::SampleType::f32, state.pass}));
    lab::TraceRequest request = job.request;
    request.progress = [&](const lab::NanTrace& found) { tell(dump(message_of(found))); };
    auto last_sent = std::chrono::steady_clock::now();
    request.stepping = [&](int frame) {
        if (const auto now = std::chrono::steady_clock::now(); now - last_sent > k_between_frames_sent) {
            last_sent = now;
            tell(dump(Json{{"frame", frame}}));
        }
    };
    auto found = TRY(lab::trace_nan(renderer, request));
    TRY(gl::check_work("tracing the origin"));
    return found;
}

/// The last result and the last frame number that the child sent.
struct Heard {
    Json line;
    int frame = -1;

    void hear(std::string_view text) {
        Json json = parse_or_discard(text);
        if (json.contains("frame"))
            frame = json["frame"].get<int>();
        else
            line = std::move(json);
    }
};

} // namespace

Result<TraceFound> trace_apart(const scene::Scene& scene, const TraceJob& job, double seconds) {
    Heard heard;
    const auto run = run_forked(
        [&](const Tell& tell) {
            const auto found = trace(scene, job, tell);
            if (!found)
                tell(dump(to_json(found.error())));
            else
                tell(dump(*found ? message_of(**found) : Json{{"finite", true}}));
        },
        seconds, [&](std::string_view text) { heard.hear(text); });
    if (!run)
        return fail(run.error());
    const Json& line = heard.line;
    if (auto error = error_of(line))
        return fail(*std::move(error));
    TraceFound result;
    result.found = line.contains("trace");
    result.ended = run->timed_out ? fmt::format("gave up after {:.3g} s", seconds) : run->crash;
    if (run->timed_out && heard.frame >= 0)
        result.ended +=
            fmt::format(" at frame {} of {}: a scene with feedback is drawn frame by frame from {}",
                        heard.frame, job.request.frame, job.request.start);
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
