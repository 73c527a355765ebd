#include "cli/check/trace_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

using lab::Birth;
using lab::NanTrace;
using Json = nlohmann::ordered_json;

std::string place(const SourceLocation& where) {
    std::string text = where.file;
    for (const int number : {where.line, where.column})
        if (number > 0)
            text += fmt::format(":{}", number);
    return text.empty() ? "(a line of tidemark's own)" : text;
}

std::string operands(const Birth& birth) {
    std::string text;
    for (const lab::TracedOperand& operand : birth.operands)
        if (operand.value)
            text += fmt::format("{}{} = {}", text.empty() ? ": " : ", ", operand.text,
                                lab::to_string(*operand.value));
    return text;
}

/// Whether the statement does nothing but store or return what the operation gives.
bool says_all(const Birth& birth) {
    if (!birth.statement.ends_with(birth.operation))
        return false;
    std::string_view before(birth.statement);
    before.remove_suffix(birth.operation.size());
    while (before.ends_with(' '))
        before.remove_suffix(1);
    return before.empty() || before.ends_with('=') || before == "return";
}

/// "`d = a / b` gave +Inf: a = 0.31, b = 0 (division by zero)".
std::string sentence(const Birth& birth) {
    const std::string_view value = birth.value ? lab::worst_of(*birth.value) : std::string_view{};
    std::string text = fmt::format("`{}` {}", birth.statement,
                                   value.empty() ? std::string("is the first that is not finite")
                                                 : fmt::format("gave {}", value));
    if (!says_all(birth))
        text += fmt::format(" in `{}`", birth.operation);
    text += operands(birth);
    if (!birth.why.reason.empty())
        text += fmt::format(" ({})", birth.why.reason);
    if (!birth.origin.empty())
        text += fmt::format("; it came in through {}", birth.origin);
    else if (birth.why.cause == lab::BirthCause::carried && birth.why.operand < birth.operands.size())
        text += "; an operand was not finite before";
    return text;
}

std::string way(const Birth& birth) {
    std::string text;
    if (birth.used)
        text += fmt::format("  in a macro used at {}\n", place(*birth.used));
    for (const lab::TracedLoop& loop : birth.loops)
        text += fmt::format("  iteration {} of the loop at {}\n", loop.iteration, place(loop.where));
    for (auto call = birth.calls.rbegin(); call != birth.calls.rend(); ++call)
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

Json to_json(const Birth& birth) {
    Json json = to_json(birth.where);
    if (birth.used)
        json["used"] = to_json(*birth.used);
    json["statement"] = birth.statement;
    json["operation"] = birth.operation;
    json["variable"] = birth.variable;
    json["function"] = birth.function;
    json["value"] = birth.value ? Json(lab::to_string(*birth.value)) : Json();
    json["operands"] = Json::array();
    for (const lab::TracedOperand& operand : birth.operands)
        json["operands"].push_back(
            {{"text", operand.text},
             {"value", operand.value ? Json(lab::to_string(*operand.value)) : Json()}});
    json["reason"] = birth.why.reason;
    json["carried"] = birth.why.cause == lab::BirthCause::carried;
    json["undefined"] = birth.why.cause == lab::BirthCause::undefined;
    json["origin"] = birth.origin;
    json["loops"] = Json::array();
    for (const lab::TracedLoop& loop : birth.loops) {
        json["loops"].push_back(to_json(loop.where));
        json["loops"].back()["iteration"] = loop.iteration;
    }
    json["calls"] = Json::array();
    for (const lab::TracedCall& call : birth.calls) {
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
    if (trace.washed)
        text += "  the pixel itself is finite: it was swallowed on the way\n";
    if (trace.cure && !trace.cure_is_first)
        text += fmt::format("{}: {}: mending this one mends the pixel\n{}", place(trace.cure->where),
                            sentence(*trace.cure), way(*trace.cure));
    for (const std::string& note : trace.notes)
        text += fmt::format("  note: {}\n", note);
    return text;
}

Json to_json(const NanTrace& trace) {
    Json json = {{"pass", trace.pass}, {"frame", trace.frame}, {"pixel", {trace.pixel.x, trace.pixel.y}}};
    if (trace.pixel.face > 0)
        json["face"] = trace.pixel.face;
    json["washed"] = trace.washed;
    json["first"] = trace.first ? to_json(*trace.first) : Json();
    json["cure"] = trace.cure ? to_json(*trace.cure) : Json();
    json["notes"] = trace.notes;
    return json;
}

} // namespace tidemark::cli
