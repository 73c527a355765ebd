#include "lab/check/promises.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tidemark::lab {
namespace {

using Json = nlohmann::json;

struct Field {
    const char* name;
    double Promises::*value;
};

constexpr Field k_fields[] = {
    {"time_horizon", &Promises::time_horizon},
    {"most_exhausted_percent", &Promises::most_exhausted_percent},
    {"most_witness_percent", &Promises::most_witness_percent},
    {"smoothest_jump", &Promises::smoothest_jump},
    {"space_horizon", &Promises::space_horizon},
};

std::string names() {
    std::string text;
    for (const Field& field : k_fields)
        text += fmt::format("{}, ", field.name);
    return text + "ranges, skip";
}

/// What is wrong with one entry; empty: it was taken.
std::string take(Promises& promises, const std::string& name, const Json& value) {
    if (name == "skip") {
        for (const auto& [probe, reason] : value.items())
            if (!value.is_object() || !reason.is_string())
                return "'skip' takes {\"probe\": \"why\"}";
            else
                promises.skip[probe] = reason.get<std::string>();
        return {};
    }
    if (name == "ranges") {
        for (const auto& [knob, range] : value.items())
            if (!value.is_object() || !range.is_array() || range.size() != 2 || !range[0].is_number() ||
                !range[1].is_number())
                return "'ranges' takes {\"knob\": [low, high]}";
            else
                promises.ranges[knob] = {range[0].get<double>(), range[1].get<double>()};
        return {};
    }
    for (const Field& field : k_fields)
        if (name == field.name) {
            if (!value.is_number() || !(value.get<double>() >= 0))
                return fmt::format("'{}' takes a number from 0", name);
            promises.*field.value = value.get<double>();
            return {};
        }
    return fmt::format("'{}' is nothing that a scene can promise; there are {}", name, names());
}

} // namespace

Result<Promises> parse_promises(std::string_view text, const std::string& file) {
    const Json json = Json::parse(text, nullptr, false, true);
    if (!json.is_object())
        return fail(ErrorCode::load, fmt::format("{}: this is no JSON object", file));
    Promises promises;
    for (const auto& [name, value] : json.items())
        if (const std::string wrong = take(promises, name, value); !wrong.empty())
            return fail(ErrorCode::load, fmt::format("{}: {}", file, wrong));
    return promises;
}

} // namespace tidemark::lab
