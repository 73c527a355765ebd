#include "cli/check_report.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/forked.hpp"
#include "host/frame_files.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "lab/report_page.hpp"
#include "render/gl_context.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::cli {

using namespace host;
using host::to_json;
namespace {

using lab::NanOrigin;
using lab::NanTrace;

std::string place(const SourceLocation& where) {
    std::string text = where.file;
    for (const int number : {where.line, where.column})
        if (number > 0)
            text += fmt::format(":{}", number);
    return text.empty() ? "(a line added by tidemark)" : text;
}

std::string operands(const NanOrigin& origin) {
    std::string text;
    for (const lab::TracedOperand& operand : origin.operands)
        if (operand.value)
            text += fmt::format("{}{} = {}", text.empty() ? ": " : ", ", operand.text,
                                lab::to_string(*operand.value));
    return text;
}

/// Returns true if the statement only stores or returns the operation's value.
bool says_all(const NanOrigin& origin) {
    if (!origin.statement.ends_with(origin.operation))
        return false;
    std::string_view before(origin.statement);
    before.remove_suffix(origin.operation.size());
    while (before.ends_with(' '))
        before.remove_suffix(1);
    return before.empty() || before.ends_with('=') || before == "return";
}

/// Returns for example "`d = a / b` gave +Inf: a = 0.31, b = 0 (division by zero)".
std::string sentence(const NanOrigin& origin) {
    const std::string_view value = origin.value ? lab::worst_of(*origin.value) : std::string_view{};
    std::string text = fmt::format("`{}` {}", origin.statement,
                                   value.empty() ? std::string("is the first value that is not finite")
                                                 : fmt::format("gave {}", value));
    if (!says_all(origin))
        text += fmt::format(" in `{}`", origin.operation);
    text += operands(origin);
    if (!origin.why.reason.empty())
        text += fmt::format(" ({})", origin.why.reason);
    if (!origin.source.empty())
        text += fmt::format("; it was read from {}", origin.source);
    else if (origin.why.cause == lab::OriginCause::carried && origin.why.operand < origin.operands.size())
        text += "; an operand was already not finite";
    return text;
}

std::string way(const NanOrigin& origin) {
    std::string text;
    if (origin.used)
        text += fmt::format("  in a macro used at {}\n", place(*origin.used));
    for (const lab::TracedLoop& loop : origin.loops)
        text += fmt::format("  iteration {} of the loop at {}\n", loop.iteration, place(loop.where));
    for (auto call = origin.calls.rbegin(); call != origin.calls.rend(); ++call)
        if (!call->where.file.empty())
            text += fmt::format("  in {}, called at {}\n", call->function, place(call->where));
    return text;
}

std::string pixel_text(const NanTrace& trace) {
    return fmt::format("{}, frame {}, pixel {},{}{}", trace.pass, trace.frame, trace.pixel.x, trace.pixel.y,
                       trace.pixel.face > 0 ? fmt::format(" of face {}", trace.pixel.face) : "");
}

Json to_json(const SourceLocation& where) {
    return {{"file", where.file}, {"line", where.line}, {"column", where.column}};
}

Json to_json(const NanOrigin& origin) {
    Json json = to_json(origin.where);
    if (origin.used)
        json["used"] = to_json(*origin.used);
    json["statement"] = origin.statement;
    json["operation"] = origin.operation;
    json["variable"] = origin.variable;
    json["function"] = origin.function;
    json["value"] = origin.value ? Json(lab::to_string(*origin.value)) : Json();
    json["operands"] = Json::array();
    for (const lab::TracedOperand& operand : origin.operands)
        json["operands"].push_back(
            {{"text", operand.text},
             {"value", operand.value ? Json(lab::to_string(*operand.value)) : Json()}});
    json["reason"] = origin.why.reason;
    json["carried"] = origin.why.cause == lab::OriginCause::carried;
    json["undefined"] = origin.why.cause == lab::OriginCause::undefined;
    json["origin"] = origin.source;
    json["loops"] = Json::array();
    for (const lab::TracedLoop& loop : origin.loops) {
        json["loops"].push_back(to_json(loop.where));
        json["loops"].back()["iteration"] = loop.iteration;
    }
    json["calls"] = Json::array();
    for (const lab::TracedCall& call : origin.calls) {
        json["calls"].push_back(to_json(call.where));
        json["calls"].back()["function"] = call.function;
    }
    return json;
}

} // namespace

std::string to_text(const NanTrace& trace) {
    std::string text;
    if (trace.first)
        text = fmt::format("{}: {} in {}\n{}", place(trace.first->where), sentence(*trace.first),
                           pixel_text(trace), way(*trace.first));
    else
        text = fmt::format("{} is not finite; no operation of the pixel is its origin\n", pixel_text(trace));
    if (trace.masked)
        text += "  the pixel itself is finite: the value was masked\n";
    if (trace.fix && !trace.fix_is_first)
        text += fmt::format("{}: {}; fixing this operation fixes the pixel\n{}", place(trace.fix->where),
                            sentence(*trace.fix), way(*trace.fix));
    for (const std::string& note : trace.notes)
        text += fmt::format("  note: {}\n", note);
    return text;
}

Json to_json(const NanTrace& trace) {
    Json json = {{"pass", trace.pass}, {"frame", trace.frame}, {"pixel", {trace.pixel.x, trace.pixel.y}}};
    if (trace.pixel.face > 0)
        json["face"] = trace.pixel.face;
    json["masked"] = trace.masked;
    json["first"] = trace.first ? to_json(*trace.first) : Json();
    json["fix"] = trace.fix ? to_json(*trace.fix) : Json();
    json["notes"] = trace.notes;
    return json;
}

std::optional<SourceLocation> origin_in(const Json& trace) {
    if (!trace.contains("first") || !trace["first"].is_object())
        return std::nullopt;
    const Json& first = trace["first"];
    SourceLocation where{first.at("file").get<std::string>(), first.at("line").get<int>(),
                         first.at("column").get<int>()};
    return where.file.empty() ? std::nullopt : std::optional(std::move(where));
}

namespace {

constexpr std::chrono::milliseconds k_between_frames_sent(200);

Json message_of(const lab::NanTrace& trace) {
    return {{"text", to_text(trace)}, {"trace", cli::to_json(trace)}};
}

/// Runs in the child.
Result<std::optional<lab::NanTrace>> trace(const scene::Scene& scene, const TraceJob& job, const Tell& tell) {
    const auto context = TRY(host::HeadlessContext::create(job.device));
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
        {.seconds = seconds, .unwanted = job.unwanted}, [&](std::string_view text) { heard.hear(text); });
    if (!run)
        return fail(run.error());
    const Json& line = heard.line;
    if (auto error = error_of(line))
        return fail(*std::move(error));
    TraceFound result;
    result.found = line.contains("trace");
    result.ended = run->timed_out  ? fmt::format("stopped after {:.3g} s", seconds)
                   : run->unwanted ? "interrupted"
                                   : run->crash;
    if (run->timed_out && heard.frame >= 0)
        result.ended +=
            fmt::format(" at frame {} of {}: a scene with feedback must be drawn frame by frame from {}",
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

namespace {

Json lines_of(std::span<const SourceLocation> places) {
    Json lines = Json::array();
    for (const SourceLocation& where : places)
        lines.push_back({{"file", where.file}, {"line", where.line}});
    return lines;
}

} // namespace

Json to_json(const ProbeResult& asked) {
    Json json = {{"probe", asked.probe->name},        {"verdict", int(asked.answer.verdict)},
                 {"sentence", asked.answer.sentence}, {"non_finite", asked.answer.non_finite},
                 {"seconds", asked.seconds},          {"picture", asked.picture.string()}};
    json["effect"] = asked.answer.effect;
    json["cause"] = asked.answer.cause;
    json["places"] = lines_of(asked.answer.places);
    if (asked.answer.where)
        json["where"] = to_json(*asked.answer.where);
    return json;
}

Result<ProbeResult> result_of(const Json& line) {
    const auto name = line.at("probe").get<std::string>();
    ProbeResult asked{&*std::ranges::find(lab::all_probes(), name, &lab::Probe::name), {}};
    asked.answer.verdict = lab::Verdict(line.at("verdict").get<int>());
    line.at("sentence").get_to(asked.answer.sentence);
    line.at("non_finite").get_to(asked.answer.non_finite);
    line.at("effect").get_to(asked.answer.effect);
    line.at("cause").get_to(asked.answer.cause);
    for (const Json& where : line.at("places"))
        asked.answer.places.push_back({where.at("file").get<std::string>(), where.at("line").get<int>()});
    line.at("seconds").get_to(asked.seconds);
    asked.picture = line.at("picture").get<std::string>();
    if (line.contains("where"))
        asked.answer.where = TRY(frame_state_of(line["where"]));
    return asked;
}

namespace {

using lab::Verdict;

size_t count(std::span<const ProbeResult> all, Verdict verdict) {
    return size_t(
        std::ranges::count(all, verdict, [](const ProbeResult& asked) { return asked.answer.verdict; }));
}

} // namespace

std::string reproduction(const ProbesRequest& request, const ProbeResult& asked) {
    if (!is_finding(asked.answer.verdict) || !asked.answer.where)
        return {};
    const std::filesystem::path& scene = request.scene.path;
    std::vector<std::string> words{"tidemark", "capture", file_word(scene)};
    std::ranges::copy(option_words(request.scene), std::back_inserter(words));
    std::ranges::copy(option_words(*asked.answer.where), std::back_inserter(words));
    words.insert(words.end(), {"-o", file_word(name_after_scene(scene, ".exr"))});
    return shell_words(words);
}

namespace {

Json to_json(const JoinedFinding& finding) {
    Json json = {{"level", lab::to_string(finding.level)},
                 {"message", finding.message},
                 {"places", lines_of(finding.places)},
                 {"probes", Json::array()}};
    for (const ProbeResult* result : finding.results)
        json["probes"].push_back(result->probe->name);
    if (!finding.command.empty())
        json[finding.remedy == lab::Remedy::show ? "see" : "try"] = finding.command;
    return json;
}

} // namespace

std::string report(const ProbesRequest& request, std::span<const ProbeResult> all) {
    Json json = {{"tidemark", k_version}, {"scene", request.scene.path.string()}};
    json["probes"] = Json::array();
    for (const ProbeResult& asked : all) {
        Json entry = {{"probe", asked.probe->name},
                      {"verdict", lab::to_string(asked.answer.verdict)},
                      {"found", asked.answer.sentence},
                      {"seconds", asked.seconds}};
        if (const std::string command = reproduction(request, asked); !command.empty())
            entry["reproduction"] = command;
        if (!asked.picture.empty())
            entry["picture"] = asked.picture.string();
        if (asked.answer.non_finite) {
            entry["trace"] = asked.trace_json;
            entry["traced"] = asked.trace;
        }
        json["probes"].push_back(std::move(entry));
    }
    json["findings"] = Json::array();
    for (const JoinedFinding& finding : joined_findings(request, all))
        json["findings"].push_back(to_json(finding));
    return dump(json, 2) + "\n";
}

int exit_code(std::span<const ProbeResult> all) {
    return count(all, Verdict::fail) > 0  ? exit_code(ErrorCode::check_failed)
           : count(all, Verdict::cut) > 0 ? exit_code(ErrorCode::timed_out)
                                          : 0;
}

namespace {

using lab::Verdict;
using report::escaped;

struct Group {
    Verdict verdict;
    const char* style; ///< class of page/style.css, and the group's anchor
    const char* heading;
};

/// The most urgent group first.
constexpr Group k_groups[] = {
    {Verdict::fail, "fail", "Failures"}, {Verdict::warn, "warn", "Warnings"},
    {Verdict::note, "remark", "Notes"},  {Verdict::cut, "cut", "Cut off by --budget"},
    {Verdict::pass, "pass", "Passed"},   {Verdict::not_applicable, "not-applicable", "Not applicable"}};

using Results = std::vector<const ProbeResult*>;

Results of_verdict(std::span<const ProbeResult> all, Verdict verdict) {
    Results found;
    for (const ProbeResult& asked : all)
        if (asked.answer.verdict == verdict)
            found.push_back(&asked);
    return found;
}

/// Embeds the picture; probes draw small ones, so all fit into the page.
std::string picture(const ProbeResult& asked) {
    if (asked.picture.empty())
        return {};
    const auto bytes = read_file(asked.picture);
    if (!bytes)
        return {};
    return fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"picture of {}\"></figure>\n",
                       base64(*bytes), escaped(asked.probe->name));
}

/// Returns what one probe says of a finding.
std::string words(const ProbesRequest& request, const ProbeResult& asked) {
    std::string html =
        fmt::format("<h4>{} <span class=\"badge\">{}</span></h4>\n<p>{}</p>\n<p class=\"note\">{}.</p>\n",
                    escaped(asked.probe->name), lab::to_string(asked.answer.verdict),
                    escaped(asked.answer.sentence), escaped(asked.probe->about));
    if (!asked.trace.empty())
        html += fmt::format("<pre>{}</pre>\n", report::escaped_lines(asked.trace));
    if (const std::string command = reproduction(request, asked); !command.empty())
        html += report::command(command);
    return html;
}

std::string article(const ProbesRequest& request, const JoinedFinding& finding, const char* style) {
    std::string shown, text = fmt::format("<h3>{}</h3>\n", escaped(finding.message));
    if (!finding.places.empty())
        text += fmt::format("<p>{}</p>\n", escaped(places_in_words(finding.places)));
    if (!finding.command.empty() && finding.remedy != lab::Remedy::show)
        text += report::command(finding.command);
    for (const ProbeResult* result : finding.results) {
        text += words(request, *result);
        shown += picture(*result);
    }
    return fmt::format("<article class=\"finding {}{}\">\n<div>\n{}</div>\n<div>{}</div></article>\n", style,
                       shown.empty() ? "" : " pictured", text, shown);
}

/// Lists results, with probes that have the same sentence in one row.
std::string short_rows(const Results& results) {
    std::vector<std::pair<std::string, std::string>> rows; // probes, sentence
    for (const ProbeResult* asked : results) {
        const auto same =
            std::ranges::find(rows, asked->answer.sentence, &std::pair<std::string, std::string>::second);
        if (same == rows.end())
            rows.emplace_back(asked->probe->name, asked->answer.sentence);
        else
            same->first += fmt::format(", {}", asked->probe->name);
    }
    std::string html = "<dl class=\"rows\">\n";
    for (const auto& [probes, sentence] : rows)
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(probes), escaped(sentence));
    return html + "</dl>\n";
}

std::string heading(const Group& group) {
    return fmt::format("<h2 id=\"{}\">{}</h2>\n", group.style, group.heading);
}

std::string link(const Group& group, const std::string& number) {
    return fmt::format("<li><a class=\"{0}\" href=\"#{0}\"><b>{1}</b> {2}</a></li>\n", group.style, number,
                       lab::to_string(group.verdict));
}

} // namespace

std::string verdict_page(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds) {
    const std::vector<JoinedFinding> findings = joined_findings(request, all);
    std::string counts, sections;
    for (const Group& group : k_groups) {
        std::string body;
        size_t number = 0;
        if (is_finding(group.verdict)) {
            for (const JoinedFinding& finding : findings)
                if (finding.level == group.verdict) {
                    body += article(request, finding, group.style);
                    ++number;
                }
        } else if (const Results results = of_verdict(all, group.verdict); !results.empty()) {
            body = short_rows(results);
            number = results.size();
        }
        if (number == 0)
            continue;
        counts += link(group, std::to_string(number));
        sections += heading(group) + body;
    }
    const std::string name = name_after_scene(request.scene.path, "");
    return report::make_page({name + ": can its numbers be trusted?", name,
                              fmt::format("Can its numbers be trusted? {} probes in {:.1f} s: {}.",
                                          all.size(), seconds, counted(findings)),
                              "<ul class=\"counts\">\n" + counts + "</ul>\n" + sections});
}

} // namespace tidemark::cli
