#include "cli/check/trace_text.hpp"

#include "cli/json_dump.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

using lab::NanOrigin;
using lab::NanTrace;

std::string place(const SourceLocation& where) {
    std::string text = where.file;
    for (const int number : {where.line, where.column})
        if (number > 0)
            text += fmt::format(":{}", number);
    return text.empty() ? "(a line of tidemark's own)" : text;
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
                                   value.empty() ? std::string("is the first that is not finite")
                                                 : fmt::format("gave {}", value));
    if (!says_all(origin))
        text += fmt::format(" in `{}`", origin.operation);
    text += operands(origin);
    if (!origin.why.reason.empty())
        text += fmt::format(" ({})", origin.why.reason);
    if (!origin.source.empty())
        text += fmt::format("; it came in through {}", origin.source);
    else if (origin.why.cause == lab::OriginCause::carried && origin.why.operand < origin.operands.size())
        text += "; an operand was not finite before";
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
        text = fmt::format("{} is not finite; no operation in it gave that\n", pixel_text(trace));
    if (trace.masked)
        text += "  the pixel itself is finite: it was masked on the way\n";
    if (trace.fix && !trace.fix_is_first)
        text += fmt::format("{}: {}: fixing this one fixes the pixel\n{}", place(trace.fix->where),
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

} // namespace tidemark::cli
