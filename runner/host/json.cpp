#include "host/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <limits>
#include <tuple>

namespace tidemark::host {

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json parse_json(std::string_view text) {
    return Json::parse(text);
}

Json parse_or_discard(std::string_view text) {
    return Json::parse(text, nullptr, false);
}

Json to_json(const Error& error) {
    Json diagnostics = Json::array();
    for (const Diagnostic& d : error.diagnostics)
        diagnostics.push_back({d.where.file, d.where.line, d.where.column, int(d.severity), d.message});
    return {{"error", error.message}, {"code", int(error.code)}, {"diagnostics", diagnostics}};
}

std::optional<Error> error_of(const Json& line) {
    if (!line.contains("error"))
        return std::nullopt;
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

namespace {

/// Returns the members of the fields' own types.
struct Parts {
    auto operator()(Extent& e) const { return std::tie(e.width, e.height); }
    auto operator()(glm::vec2& v) const { return std::tie(v.x, v.y); }
    auto operator()(glm::dvec3& v) const { return std::tie(v.x, v.y, v.z); }
    auto operator()(render::Date& d) const { return std::tie(d.year, d.month, d.day, d.seconds); }
    auto operator()(render::Mouse& m) const { return std::tie(m.position, m.pressed_at, m.down, m.is_new); }
    auto operator()(render::OrbitCamera& c) const {
        return std::tie(c.azimuth, c.elevation, c.distance, c.target);
    }
    auto operator()(scene::Setting& s) const { return std::tie(s.name, s.value); }
};

template <class T>
concept HasParts = std::invocable<Parts, T&>;

Json encode(const scene::KnobSetting& setting) {
    return Json::array({setting.name, scene::to_string(setting.value)});
}
template <class T>
Json encode(T value) {
    if constexpr (HasParts<T>)
        return std::apply([](auto&... part) { return Json::array({encode(part)...}); }, Parts{}(value));
    else
        return value;
}
template <class T>
Json encode(const std::optional<T>& value) {
    return value ? encode(*value) : Json();
}
template <class T>
Json encode(const std::vector<T>& values) {
    Json json = Json::array();
    for (const T& value : values)
        json.push_back(encode(value));
    return json;
}

template <class T>
void decode(const Json& json, T& value) {
    using Limits = std::numeric_limits<T>;
    if constexpr (HasParts<T>)
        std::apply([&, i = size_t(0)](auto&... part) mutable { (decode(json.at(i++), part), ...); },
                   Parts{}(value));
    // An untrusted file may hold any number.
    else if constexpr (std::is_arithmetic_v<T> && !std::same_as<T, bool>)
        value = T(std::clamp(json.get<double>(), double(Limits::lowest()), double(Limits::max())));
    else
        json.get_to(value);
}
template <class T, size_t N>
void decode(const Json& json, std::array<T, N>& values) {
    for (size_t i = 0; i < N; ++i)
        decode(json.at(i), values[i]);
}
template <class T>
void decode(const Json& json, std::optional<T>& value) {
    if (!json.is_null())
        decode(json, value.emplace());
}
template <class T>
void decode(const Json& json, std::vector<T>& values) {
    for (const Json& each : json)
        decode(each, values.emplace_back());
}

Result<std::vector<scene::KnobSetting>> knob_settings_of(const Json& json) {
    std::vector<scene::KnobSetting> settings;
    for (const Json& each : json) {
        const auto name = each.at(0).get<std::string>(), text = each.at(1).get<std::string>();
        settings.push_back(TRY(scene::parse_knob_setting(name, text)));
    }
    return settings;
}

} // namespace

Json to_json(const render::FrameState& state) {
    Json json;
    render::for_each_field(
        [&](const auto& field) { json[std::string(field.name)] = encode(state.*field.member); });
    return json;
}

Json changes_of(const render::FrameState& state) {
    const render::FrameState plain;
    Json json = Json::object();
    render::for_each_field([&](const auto& field) {
        if (state.*field.member != plain.*field.member)
            json[std::string(field.name)] = encode(state.*field.member);
    });
    return json;
}

Result<render::FrameState> frame_state_of(const Json& json) {
    render::FrameState state;
    Result<std::vector<scene::KnobSetting>> knobs;
    render::for_each_field([&](const auto& field) {
        const auto found = json.find(std::string(field.name));
        if (found == json.end())
            return;
        if constexpr (std::same_as<decltype(state.*field.member), std::vector<scene::KnobSetting>&>)
            knobs = knob_settings_of(*found);
        else
            decode(*found, state.*field.member);
    });
    state.knobs = TRY(std::move(knobs));
    return state;
}

Json run_numbers(const render::FrameState& state) {
    Json json = Json::object();
    render::for_each_number([&](const auto& field) { json[std::string(field.name)] = state.*field.member; });
    return json;
}

} // namespace tidemark::host
