#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/trace_report.hpp"
#include "gl/reset.hpp"
#include "lab/pixel/pixel_trace.hpp"
#include "platform/headless_context.hpp"
#include "render/frame_stepper.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <memory>

namespace tidemark::cli {
namespace {

struct TraceCommand {
    SceneRequest scene;
    FrameOptions frames;
    std::string pixel, line, turns;
    uint64_t seed = 1;
    platform::DeviceChoice device{};
    bool json = false;
};

bool read(std::string_view text, auto& number) {
    const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
    return end.ec == std::errc{} && end.ptr == text.data() + text.size();
}

/// Parses `N` or `FILE:N`.
Result<std::optional<SourceLocation>> parse_line(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    SourceLocation where;
    const size_t colon = text.rfind(':');
    if (colon != std::string::npos)
        where.file = text.substr(0, colon);
    if (!read(std::string_view(text).substr(colon == std::string::npos ? 0 : colon + 1), where.line) ||
        where.line < 1)
        return fail(ErrorCode::usage, fmt::format("--line {}: give a line from 1, or FILE:LINE", text));
    return where;
}

/// Parses `N` or `A-B`.
Result<std::optional<lab::TurnRange>> parse_turns(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    lab::TurnRange range;
    const std::string_view all = text;
    const size_t dash = all.find('-');
    const bool good = read(all.substr(0, dash), range.first) &&
                      read(all.substr(dash == std::string::npos ? 0 : dash + 1), range.second);
    if (!good || range.first < 1 || range.second < range.first)
        return fail(ErrorCode::usage,
                    fmt::format("--turns {}: give a turn of the loop from 1, or a range, as in 4-20", text));
    return range;
}

Result<TraceReport> trace(const TraceCommand& command, const FrameSequence& frames,
                          const lab::PixelRequest& request) {
    const auto scene = TRY(load(command.scene, frames));
    const auto context = TRY(platform::HeadlessContext::create(command.device));
    render::RenderOptions drawing;
    drawing.extent = frames.state.extent;
    drawing.samples = image::SampleType::f32;
    drawing.pass = frames.state.pass;
    drawing.specialise = glsl::Specialise::unreachable; // does not change the picture; capture uses it too
    auto renderer = TRY(render::Renderer::create(scene, drawing));
    const render::FrameStates states = states_of(frames);
    const int frame = frames.frames.front();
    render::FrameStepper(renderer, states).draw(frame);
    auto found = TRY(lab::trace_pixel(renderer, render::inputs_of(states(frame)), request));
    TRY(gl::check_work("drawing the pixel"));
    return TraceReport{scene.file.string(), renderer.shown_pass().name, frame, renderer.extent(), request,
                       std::move(found)};
}

Result<int> run_trace(const TraceCommand& command) {
    const auto frames = TRY(resolve(sized(command.frames, command.scene)));
    if (frames.frames.size() != 1)
        return fail(ErrorCode::usage, "trace looks at one frame: give --frame N or --time T");
    lab::PixelRequest request;
    request.pixel = TRY(parse_pixel(command.pixel, frames.state.extent));
    request.line = TRY(parse_line(command.line));
    request.turns = TRY(parse_turns(command.turns));
    request.seed = command.seed;
    const auto report = TRY(trace(command, frames, request));
    TRY(put(command.json ? dump(trace_json(report), 2) + "\n" : trace_text(report)));
    return report.trace.end == lab::PixelTrace::End::too_long ? exit_code(ErrorCode::timed_out) : 0;
}

} // namespace

void add_trace(Command app, Action& chosen) {
    auto options = std::make_shared<TraceCommand>();
    Command command = app.add_subcommand(
        "trace", "What each line computes for one pixel: in float, in double, and how many digits are right");
    add_scene_options(command, options->scene);
    add_picture_options(command, options->frames);
    add_time_options(command, options->frames);
    command.add_option("--pixel", options->pixel, "The pixel to follow, from the bottom left")
        .type_name("X,Y")
        .required();
    command
        .add_option("--line", options->line, "All values of that line of the text [a summary of all lines]")
        .type_name("[FILE:]N");
    command
        .add_option(
            "--turns", options->turns,
            "With --line: those turns of the innermost loop [the first, the last, and where something "
            "happens]")
        .type_name("A-B")
        .needs("--line");
    command.add_option("--seed", options->seed, "Of the roundings that are drawn by lot")
        .type_name("N")
        .check(number<uint64_t>("a whole number"))
        .capture_default_str();
    add_device_options(command, options->device);
    command.add_flag("--json", options->json, "One JSON object on standard output");
    command.on_call([options, &chosen] {
        chosen = [options]() -> Result<int> {
            Interrupt interrupt;
            const Interrupt::Immediate at_once(interrupt);
            return run_trace(*options);
        };
    });
}

} // namespace tidemark::cli
