#include "serve/state_text.hpp"

#include "web/knob_data.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tidemark::serve {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json knobs_of(const std::vector<live::KnobField>& fields) {
    Json knobs = Json::array();
    for (const live::KnobField& field : fields) {
        scene::Knob knob = field.knob;
        knob.value = field.value;
        knobs.push_back(web::knob_data(knob));
        knobs.back()["turned"] = field.is_turned();
    }
    return knobs;
}

Json definitions_of(const std::vector<live::DefinitionField>& fields) {
    Json definitions = Json::array();
    for (const live::DefinitionField& field : fields)
        definitions.push_back({{"name", field.name},
                               {"value", live::text_of(field)},
                               {"whole", field.whole},
                               {"held", field.held}});
    return definitions;
}

Json names_of(const std::vector<live::PictureField>& fields) {
    Json names = Json::array();
    for (const live::PictureField& field : fields)
        names.push_back(field.name);
    return names;
}

Json time_of(const live::TimeField& time) {
    Json data = {{"paused", time.paused},           {"speed", time.speed},
                 {"turnsBack", time.turns_back},    {"hasSpeed", time.has_speed},
                 {"from", or_null(time.loop_from)}, {"to", or_null(time.loop_to)}};
    if (time.stepping)
        data["stepping"] = {time.stepping->frame, time.stepping->last};
    return data;
}

Json errors_of(const std::vector<live::ErrorField>& fields) {
    constexpr size_t k_most_errors = 20;
    constexpr size_t k_longest_line = 100; // characters
    Json errors = Json::array();
    for (const live::ErrorField& field : fields) {
        if (errors.size() == k_most_errors)
            break;
        const live::Excerpt excerpt =
            live::excerpt_of(field.line, field.diagnostic.where.column, k_longest_line);
        errors.push_back({{"text", to_string(field.diagnostic)},
                          {"line", excerpt.text},
                          {"mark", field.line.empty() ? "" : excerpt.mark}});
    }
    return errors;
}

double in_hundredths(double value) {
    return std::round(value * 100) / 100;
}

/// Replaces bytes that are not UTF-8, which file names may contain.
std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string state_text(const live::Model& model, Extent extent, bool keyboard) {
    return dump({{"state",
                  {{"size", {extent.width, extent.height}},
                   {"keyboard", keyboard},
                   {"knobs", knobs_of(model.knobs)},
                   {"definitions", definitions_of(model.definitions)},
                   {"pictures", names_of(model.pictures)},
                   {"large", or_null(model.large)},
                   {"time", time_of(model.time)},
                   {"errors", errors_of(model.errors)}}}});
}

std::string to_text(const PictureHead& head) {
    Json costs = Json::array();
    for (const auto& cost : head.costs)
        costs.push_back(cost ? Json(in_hundredths(*cost)) : Json());
    return dump({{"number", head.number},
                 {"seconds", head.seconds},
                 {"frame", head.frame},
                 {"costs", std::move(costs)},
                 {"draw", in_hundredths(head.draw_ms)},
                 {"encode", in_hundredths(head.encode_ms)},
                 {"coding", head.coding}});
}

std::string line_text(const char* name, const std::string& line) {
    return dump({{name, line}});
}

} // namespace tidemark::serve
