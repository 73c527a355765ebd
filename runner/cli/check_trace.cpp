#include "cli/check_trace.hpp"

#include "cli/console.hpp"
#include "cli/forked.hpp"
#include "cli/trace_text.hpp"
#include "cli/version.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>

namespace tidemark::cli {
namespace {

using Json = nlohmann::ordered_json;

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

/// What the child tells: one object a line; the last is the best.
Json told(const lab::NanTrace& trace) {
    return {{"text", to_text(trace)}, {"trace", to_json(trace)}};
}

Json told(const Error& error) {
    Json diagnostics = Json::array();
    for (const Diagnostic& d : error.diagnostics)
        diagnostics.push_back({d.where.file, d.where.line, d.where.column, int(d.severity), d.message});
    return {{"error", error.message}, {"code", int(error.code)}, {"diagnostics", diagnostics}};
}

Error error_of(const Json& line) {
    Error error{ErrorCode(line.at("code").get<int>()), line.at("error").get<std::string>(), {}};
    for (const Json& d : line.at("diagnostics")) {
        Diagnostic& diagnostic = error.diagnostics.emplace_back();
        d[0].get_to(diagnostic.where.file);
        d[1].get_to(diagnostic.where.line);
        d[2].get_to(diagnostic.where.column);
        diagnostic.severity = Severity(d[3].get<int>());
        d[4].get_to(diagnostic.message);
    }
    return error;
}

std::string dump(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace); // a text may hold any bytes
}

/// In the child.
Result<std::optional<lab::NanTrace>> trace(const scene::Scene& scene, const TraceOptions& options,
                                           const FrameRequest& frames, std::optional<lab::PixelPlace> pixel,
                                           const Tell& tell) {
    const auto context = platform::HeadlessContext::create(options.device);
    if (!context)
        return fail(context.error());
    auto renderer =
        render::Renderer::create(scene, {frames.extent, image::SampleType::f32, options.frames.pass});
    if (!renderer)
        return fail(std::move(renderer.error()));
    lab::TraceRequest request;
    request.frame = frames.frames.front();
    request.inputs = [&](int frame) { return inputs_of(frames, frame); };
    request.pixel = pixel;
    request.hidden = options.hidden;
    request.progress = [&](const lab::NanTrace& found) { tell(dump(told(found))); };
    return lab::trace_nan(*renderer, request);
}

Json last_line(const std::string& output) {
    if (output.empty())
        return {};
    const size_t begin = output.rfind('\n', output.size() - 2);
    return Json::parse(output.substr(begin == output.npos ? 0 : begin + 1), nullptr, false);
}

Result<int> report(const ForkedResult& run, const TraceOptions& options, const scene::Scene& scene) {
    const Json line = last_line(run.output);
    if (line.contains("error"))
        return fail(error_of(line));
    const std::string end = run.timed_out ? fmt::format("gave up after {:.3g} s (--timeout)", options.timeout)
                            : run.signal != 0 ? fmt::format("the driver crashed (signal {})", run.signal)
                                              : "";
    const bool found = line.contains("trace");
    if (!end.empty() && !found)
        return fail(run.timed_out ? ErrorCode::timed_out : ErrorCode::load,
                    fmt::format("'{}': {}", scene.file.string(), end));
    Json json = {{"tidemark", k_version}, {"scene", scene.file.string()}, {"finite", !found}};
    json["trace"] = found ? line.at("trace") : Json();
    json["ended"] = end;
    std::string text = found            ? line.at("text").get<std::string>()
                       : options.hidden ? "every pixel is finite, and no operation gave NaN\n"
                                        : "every pixel is finite\n";
    if (!end.empty())
        text += fmt::format("  note: {}: what is said above is not the whole\n", end);
    const int code = found ? exit_code(ErrorCode::check_failed) : 0;
    return put(options.json ? dump(json, 2) + "\n" : text).map([code] { return code; });
}

} // namespace

Result<int> check_trace(const TraceOptions& options) {
    const auto frames = resolve(options.frames);
    if (!frames)
        return fail(frames.error());
    if (frames->frames.size() != 1)
        return fail(ErrorCode::usage, "--trace looks at one frame: give --frame N or --time T");
    if (!(options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    const auto pixel = parse_pixel(options.pixel, frames->extent);
    if (!pixel)
        return fail(pixel.error());
    const auto scene = load(options.scene);
    if (!scene)
        return fail(scene.error());
    const auto run = run_forked(
        [&](const Tell& tell) {
            const auto found = trace(*scene, options, *frames, *pixel, tell);
            if (!found)
                tell(dump(told(found.error())));
            else
                tell(dump(*found ? told(**found) : Json{{"finite", true}}));
        },
        options.timeout);
    if (!run)
        return fail(run.error());
    return report(*run, options, *scene);
}

} // namespace tidemark::cli
