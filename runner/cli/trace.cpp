// Formats the result of `tidemark trace` as text and as JSON.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/extent.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "lab/pixel_trace.hpp"
#include "render/frame_stepper.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace tidemark::cli {

using namespace host;
using host::resolve;
namespace {

struct TraceReport {
    std::string scene{};
    std::string pass{};
    int frame = 0;
    Extent extent{};
    lab::PixelRequest request{};
    lab::PixelTrace trace{};
};

using lab::LineInCall;
using lab::PixelTrace;
using lab::TracedLine;
using lab::TracedValue;

constexpr const char* k_components = "xyzw";
/// The most lines per section of a summary.
constexpr size_t k_most_lines = 5;
/// The most calls shown for a line in a function that is called from many places; --json has all.
constexpr size_t k_most_calls = 8;
/// The least number of lost digits that is reported.
constexpr double k_least_loss = 1;

// -- Values as text

std::string file_and_line(const SourceLocation& where) {
    return fmt::format("{}:{}", where.file, where.line);
}

std::string turn_number(const lab::Turns& turns) {
    return fmt::format("{}", fmt::join(turns, "."));
}
std::string turn_words(const lab::Turns& turns) {
    return turns.empty() ? "" : " in iteration " + turn_number(turns);
}

/// Returns NaN, +Inf or -Inf; empty for a finite number.
std::string special_text(double number) {
    if (std::isnan(number))
        return "NaN";
    return std::isinf(number) ? number > 0 ? "+Inf" : "-Inf" : "";
}

std::string number_text(double number, TracedValue::Kind kind, int digits) {
    if (kind == TracedValue::Kind::condition)
        return number != 0 ? "true" : "false";
    if (!std::isfinite(number))
        return special_text(number);
    return kind == TracedValue::Kind::whole ? fmt::format("{:.0f}", number)
                                            : fmt::format("{:.{}g}", number, digits);
}
std::string float_text(double number, TracedValue::Kind kind) {
    return number_text(number, kind, 9);
}
std::string double_text(double number, TracedValue::Kind kind) {
    return number_text(number, kind, 12);
}

std::string component_name(const TracedValue& value, size_t component) {
    if (value.in_float.size() == 1)
        return value.name;
    if (value.in_float.size() == value.rows && value.rows <= 4)
        return fmt::format("{}.{}", value.name, k_components[component]);
    return fmt::format("{}[{}][{}]", value.name, component / value.rows, component % value.rows);
}

std::string head(const TraceReport& report) {
    return fmt::format("{}, frame {}, pixel {},{} of {}x{}; {} operations, {} samples of stochastic "
                       "arithmetic from seed {}\n",
                       report.pass, report.frame, report.request.pixel.x, report.request.pixel.y,
                       report.extent.width, report.extent.height, report.trace.operations, proof::k_samples,
                       report.request.seed);
}

std::string colour(const PixelTrace& trace) {
    if (trace.end == PixelTrace::End::discarded)
        return "the pixel is discarded\n";
    if (trace.end == PixelTrace::End::too_long)
        return "stopped: the pixel takes too many operations; the rest covers only the operations up to "
               "there\n";
    std::string text =
        fmt::format("  {:8}{:>16}{:>20}{:>8}{:>16}\n", "colour", "float", "double", "digits", "device");
    for (size_t i = 0; i < trace.in_float.size(); ++i)
        text += fmt::format("  {:8}{:>16}{:>20}{:>8.1f}{:>16}\n", "rgba"[i],
                            float_text(trace.in_float[i], TracedValue::Kind::real),
                            double_text(trace.in_double[i], TracedValue::Kind::real), trace.digits[i],
                            float_text(trace.on_device[i], TracedValue::Kind::real));
    if (trace.at_base_level)
        text += "  note: textures are read at their base level here; the device chooses a mipmap\n";
    if (!lab::is_as_drawn(trace))
        text += "  the device's colour differs by more than rounding: its functions or filters differ, or it "
                "combines operations\n";
    return text;
}

// -- Report of one line

std::string mark(const TracedValue& value, double fewest) {
    if (!value.finite())
        return "  not finite";
    if (value.mismatch())
        return "  differs in double";
    if (value.unstable)
        return "  decided by rounding";
    if (value.kind == TracedValue::Kind::real && value.digits == fewest)
        return "  fewest digits";
    return value.carried ? "  at iteration start" : "";
}

std::string row(const TracedValue& value, size_t component, double fewest) {
    const bool first = component == 0;
    std::string text =
        fmt::format("  {:>9}  {:16}{:>16}{:>20}", first ? turn_number(value.turns) : "",
                    component_name(value, component), float_text(value.in_float[component], value.kind),
                    double_text(value.in_double[component], value.kind));
    if (first)
        text += fmt::format("{:>8}{}",
                            value.kind == TracedValue::Kind::real ? fmt::format("{:.1f}", value.digits) : "",
                            mark(value, fewest));
    return text.erase(text.find_last_not_of(' ') + 1) + "\n";
}

std::string callers(const LineInCall& call) {
    std::string text;
    for (const SourceLocation& where : call.callers)
        text += fmt::format("{}{}", text.empty() ? "  called at " : ", from ", file_and_line(where));
    return text.empty() ? "" : text + "\n";
}

/// Returns the fewest digits of any real value, at most a threshold above which values are not marked.
double fewest_of(const std::vector<LineInCall>& calls) {
    double fewest = proof::k_most_digits - k_least_loss;
    for (const LineInCall& call : calls)
        for (const TracedValue& value : call.values)
            if (value.kind == TracedValue::Kind::real)
                fewest = std::min(fewest, value.digits);
    return fewest;
}

std::string rows_of(const LineInCall& call, double fewest) {
    std::string text = callers(call);
    std::map<std::string, uint64_t> numbers; // number of the previous value, by name
    bool gap_said = false;
    for (const TracedValue& value : call.values) {
        uint64_t& before = numbers[value.name];
        if (value.number > before + 1 && !gap_said)
            text += "          …\n";
        gap_said = value.number > before + 1;
        before = value.number;
        for (size_t i = 0; i < value.in_float.size(); ++i)
            text += row(value, i, fewest);
    }
    return text;
}

std::string file_and_line(const TraceReport& report) {
    const auto& calls = report.trace.calls;
    const lab::AuthorLine& asked = *report.trace.asked;
    std::string text = fmt::format("{}:  {}\n", file_and_line(asked.where), asked.text);
    if (calls.empty())
        return text + fmt::format("  the pixel does not reach this line{}\n",
                                  report.request.turns ? " in these iterations" : "");
    text +=
        fmt::format("  {:>9}  {:16}{:>16}{:>20}{:>8}\n", "iteration", "value", "float", "double", "digits");
    const double fewest = fewest_of(calls);
    for (size_t i = 0; i < std::min(calls.size(), k_most_calls); ++i)
        text += rows_of(calls[i], fewest);
    if (calls.size() > k_most_calls)
        text += fmt::format("  and in {} more calls (--json lists all)\n", calls.size() - k_most_calls);
    return text;
}

// -- Summary

using Weight = double (*)(const TracedLine&);
using Sentence = std::string (*)(const TracedLine&);

/// Lists lines with a positive weight, the largest first.
std::string section(const std::string& title, const std::vector<TracedLine>& lines, Weight weight,
                    Sentence sentence) {
    std::vector<const TracedLine*> chosen;
    for (const TracedLine& line : lines)
        if (weight(line) > 0)
            chosen.push_back(&line);
    std::ranges::stable_sort(chosen, [&](const auto* a, const auto* b) { return weight(*a) > weight(*b); });
    std::string text = chosen.empty() ? "" : title + "\n";
    for (size_t i = 0; i < std::min(chosen.size(), k_most_lines); ++i)
        text += fmt::format("  {}: {}\n      {}\n", file_and_line(chosen[i]->line.where),
                            sentence(*chosen[i]), chosen[i]->line.text);
    if (chosen.size() > k_most_lines)
        text += fmt::format("  and {} more lines\n", chosen.size() - k_most_lines);
    return text;
}

std::string lost_words(const TracedLine& line) {
    std::string text = fmt::format("{:.1f} lost{}", line.lost, turn_words(line.lost_turns));
    if (!line.fewest.empty())
        text += fmt::format("; {} has {:.1f}{}", line.fewest, line.digits, turn_words(line.fewest_turns));
    return text;
}

/// Returns for example " in iteration 7, 3 times in total".
std::string occurrence_words(const lab::Occurrence& what) {
    return turn_words(what.first) + (what.times > 1 ? fmt::format(", {} times in total", what.times) : "");
}

std::string mismatch_words(const TracedLine& line) {
    return (line.float_holds ? "holds in float, not in double" : "holds in double, not in float") +
           occurrence_words(line.mismatch);
}

std::string unstable_words(const TracedLine& line) {
    return "the condition" + occurrence_words(line.unstable);
}

std::string not_finite_words(const TracedLine& line) {
    return line.not_finite->name + turn_words(line.not_finite->turns);
}

double loss_of(const TracedLine& line) {
    return line.lost >= k_least_loss ? line.lost : 0;
}
double mismatches_of(const TracedLine& line) {
    return double(line.mismatch.times);
}
double instabilities_of(const TracedLine& line) {
    return double(line.unstable.times);
}
/// Gives the earliest line the largest weight, since the NaN or infinity originates there.
double earliness_of(const TracedLine& line) {
    return line.not_finite ? 1 / double(line.not_finite->order) : 0;
}

std::string summary(const PixelTrace& trace) {
    const auto& lines = trace.lines;
    const std::string losses = fmt::format("lost digits (a float has {:.1f})", proof::k_most_digits);
    const std::string text =
        section(losses, lines, loss_of, lost_words) +
        section("conditions that differ in float and double", lines, mismatches_of, mismatch_words) +
        section("conditions decided by rounding", lines, instabilities_of, unstable_words) +
        section("not finite", lines, earliness_of, not_finite_words);
    return text.empty() ? "no line loses more than one digit; float and double take the same branches\n"
                        : text;
}

// -- JSON

Json number_json(double number) {
    return std::isfinite(number) ? Json(number) : Json(special_text(number));
}
Json numbers_json(const auto& numbers) {
    Json json = Json::array();
    for (const double number : numbers)
        json.push_back(number_json(number));
    return json;
}

Json json_of(const TracedValue& value) {
    static constexpr const char* k_kind_names[] = {"real", "whole", "condition"};
    return {{"name", value.name},
            {"kind", k_kind_names[size_t(value.kind)]},
            {"carried", value.carried},
            {"turns", value.turns},
            {"number", value.number},
            {"rows", value.rows},
            {"float", numbers_json(value.in_float)},
            {"double", numbers_json(value.in_double)},
            {"digits", value.digits},
            {"unstable", value.unstable}};
}

Json json_of(const TracedLine& line) {
    Json json = {{"file", line.line.where.file}, {"line", line.line.where.line}, {"text", line.line.text},
                 {"values", line.values},        {"digits", line.digits},        {"lost", line.lost}};
    if (!line.fewest.empty())
        json["fewest"] = {{"name", line.fewest}, {"turns", line.fewest_turns}};
    if (line.not_finite)
        json["not_finite"] = json_of(*line.not_finite);
    if (line.mismatch.times > 0)
        json["parted"] = {{"times", line.mismatch.times},
                          {"turns", line.mismatch.first},
                          {"float_holds", line.float_holds}};
    if (line.unstable.times > 0)
        json["unstable"] = {{"times", line.unstable.times}, {"turns", line.unstable.first}};
    return json;
}

Json json_of(const LineInCall& call) {
    Json json = {{"function", call.function}, {"called_at", Json::array()}, {"values", Json::array()}};
    for (const SourceLocation& where : call.callers)
        json["called_at"].push_back({{"file", where.file}, {"line", where.line}});
    for (const TracedValue& value : call.values)
        json["values"].push_back(json_of(value));
    return json;
}

std::string trace_text(const TraceReport& report) {
    std::string text = head(report) + colour(report.trace);
    return text + (report.trace.asked ? file_and_line(report) : summary(report.trace));
}

Json trace_json(const TraceReport& report) {
    static constexpr const char* k_ends[] = {"complete", "discarded", "too long"};
    const PixelTrace& trace = report.trace;
    Json json = {{"tidemark", k_version},
                 {"scene", report.scene},
                 {"pass", report.pass},
                 {"frame", report.frame},
                 {"pixel", {report.request.pixel.x, report.request.pixel.y}},
                 {"size", {report.extent.width, report.extent.height}},
                 {"seed", report.request.seed},
                 {"samples", proof::k_samples},
                 {"end", k_ends[size_t(trace.end)]},
                 {"operations", trace.operations},
                 {"colour",
                  {{"float", numbers_json(trace.in_float)},
                   {"double", numbers_json(trace.in_double)},
                   {"digits", numbers_json(trace.digits)},
                   {"device", numbers_json(trace.on_device)},
                   {"as_drawn", lab::is_as_drawn(trace)},
                   {"textures_at_base_level", trace.at_base_level}}},
                 {"lines", Json::array()}};
    for (const TracedLine& line : trace.lines)
        json["lines"].push_back(json_of(line));
    if (trace.asked) {
        json["calls"] = Json::array();
        for (const LineInCall& call : trace.calls)
            json["calls"].push_back(json_of(call));
    }
    return json;
}

struct TraceCommand {
    SceneRequest scene;
    FrameOptions frames;
    std::string pixel, line, turns;
    uint64_t seed = 1;
    host::DeviceChoice device{};
    bool json = false;
};

/// Parses `N` or `FILE:N`.
Result<std::optional<SourceLocation>> parse_line(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    SourceLocation where;
    const size_t colon = text.rfind(':');
    if (colon != std::string::npos)
        where.file = text.substr(0, colon);
    where.line = number_from<int>(text.substr(colon + 1)).value_or(0); // npos + 1 is 0
    if (where.line < 1)
        return fail(ErrorCode::usage, fmt::format("--line {}: give a line from 1, or FILE:LINE", text));
    return where;
}

/// Parses `N` or `A-B`.
Result<std::optional<lab::TurnRange>> parse_turns(const std::string& text) {
    if (text.empty())
        return std::nullopt;
    const auto ends = numbers_from<uint32_t>(text, '-');
    if (ends.empty() || ends.size() > 2 || ends.front() < 1 || ends.back() < ends.front())
        return fail(
            ErrorCode::usage,
            fmt::format("--turns {}: give an iteration of the loop, from 1, or a range, as in 4-20", text));
    return lab::TurnRange{ends.front(), ends.back()};
}

Result<TraceReport> trace(const TraceCommand& command, const FrameSequence& frames,
                          const lab::PixelRequest& request) {
    const auto scene = TRY(load(command.scene, frames));
    const auto context = TRY(host::HeadlessContext::create(command.device));
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
        return fail(ErrorCode::usage, "trace works on one frame: give --frame N or --time T");
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
        "trace",
        "Shows what each line computes for one pixel, in float and in double, and how many digits are right");
    add_scene_options(command, options->scene);
    add_picture_options(command, options->frames);
    add_time_options(command, options->frames);
    command.add_option("--pixel", options->pixel, "Pixel to trace, counted from the bottom left")
        .type_name("X,Y")
        .required();
    command
        .add_option("--line", options->line,
                    "Shows all values of that line of the text [a summary of all lines]")
        .type_name("[FILE:]N");
    command
        .add_option("--turns", options->turns,
                    "With --line: iterations of the innermost loop to show [the first, the last, and the "
                    "notable ones]")
        .type_name("A-B")
        .needs("--line");
    command.add_option("--seed", options->seed, "Seed of the random rounding")
        .type_name("N")
        .check(number<uint64_t>("a whole number"))
        .capture_default_str();
    add_device_options(command, options->device);
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] {
        chosen = [options]() -> Result<int> {
            Interrupt interrupt;
            const Interrupt::Immediate at_once(interrupt);
            return run_trace(*options);
        };
    });
}

} // namespace tidemark::cli
