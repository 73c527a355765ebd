#include "lab/check/promises.hpp"

#include "lab/check/probe.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tidemark::lab {
namespace {

using Json = nlohmann::json;

struct Field {
    std::string_view name;
    double Promises::*value;
};

constexpr Field k_fields[] = {
    {"time_horizon", &Promises::time_horizon},
    {"most_exhausted_percent", &Promises::most_exhausted_percent},
    {"most_overstep_percent", &Promises::most_overstep_percent},
    {"smoothest_jump", &Promises::smoothest_jump},
    {"space_horizon", &Promises::space_horizon},
    {"largest_slope", &Promises::largest_slope},
};

std::string names() {
    std::string text;
    for (const Field& field : k_fields)
        text += fmt::format("{}, ", field.name);
    return text + "ranges, skip, when";
}

std::string take_reasons(Promises& promises, const Json& reasons) {
    if (!reasons.is_object())
        return R"('skip' takes {"probe": "why"})";
    for (const auto& [probe, reason] : reasons.items()) {
        if (!reason.is_string())
            return R"('skip' takes {"probe": "why"})";
        promises.skip[std::string(probe_name(probe))] = reason.get<std::string>();
    }
    return {};
}

std::string take_ranges(Promises& promises, const Json& ranges) {
    constexpr const char* k_form = "'ranges' takes {\"knob\": [low, high]}";
    if (!ranges.is_object())
        return k_form;
    for (const auto& [knob, range] : ranges.items()) {
        if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number() ||
            range[0].get<double>() > range[1].get<double>())
            return k_form;
        promises.ranges[knob] = {range[0].get<double>(), range[1].get<double>()};
    }
    return {};
}

/// Sets one number, also by its name of version 0.1.
std::string take_number(Promises& promises, std::string name, const Json& value) {
    if (name == "most_witness_percent")
        name = "most_overstep_percent";
    const auto field = std::ranges::find(k_fields, name, &Field::name);
    if (field == std::end(k_fields))
        return fmt::format("'{}' is nothing that a scene can promise; there are {}", name, names());
    if (!value.is_number() || !(value.get<double>() >= 0))
        return fmt::format("'{}' takes a number from 0", name);
    promises.*(field->value) = value.get<double>();
    promises.stated.insert(name);
    return {};
}

/// Applies one entry; returns what is wrong with it, or an empty text.
std::string take(Promises& promises, const std::string& name, const Json& value) {
    return name == "skip"     ? take_reasons(promises, value)
           : name == "ranges" ? take_ranges(promises, value)
                              : take_number(promises, name, value);
}

/// Applies the entries whose definition holds. The others are parsed as well, so that their errors are
/// reported.
std::string take_conditional(Promises& promises, const Json& conditional, const DefinitionOf& definition_of) {
    constexpr const char* k_form = "'when' takes {\"NAME=VALUE\": {promises}}";
    if (!conditional.is_object())
        return k_form;
    for (const auto& [condition, entries] : conditional.items()) {
        const size_t equals = condition.find('=');
        if (equals == condition.npos || !entries.is_object())
            return k_form;
        const bool holds = definition_of(condition.substr(0, equals)) == condition.substr(equals + 1);
        Promises unused;
        for (const auto& [name, value] : entries.items())
            if (std::string wrong = take(holds ? promises : unused, name, value); !wrong.empty())
                return wrong;
    }
    return {};
}

/// Applies all entries; returns what is wrong with the first invalid one, or an empty text.
std::string take_all(Promises& promises, const Json& entries, const DefinitionOf& definition_of) {
    for (const auto& [name, value] : entries.items())
        if (name != "when")
            if (std::string wrong = take(promises, name, value); !wrong.empty())
                return wrong;
    // Conditional entries come last: they override the plain ones, in any order of the file.
    return entries.contains("when") ? take_conditional(promises, entries["when"], definition_of) : "";
}

} // namespace

Result<Promises> parse_promises(std::string_view text, const std::string& file,
                                const DefinitionOf& definition_of) {
    const Json json = Json::parse(text, nullptr, false, true);
    if (!json.is_object())
        return fail(ErrorCode::load, fmt::format("{}: this is no JSON object", file));
    Promises promises;
    if (const std::string wrong = take_all(promises, json, definition_of); !wrong.empty())
        return fail(ErrorCode::load, fmt::format("{}: {}", file, wrong));
    return promises;
}

} // namespace tidemark::lab
