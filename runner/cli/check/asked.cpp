#include "cli/check/asked.hpp"

#include <algorithm>

namespace tidemark::cli {
namespace {

Json told(const std::vector<lab::Setting>& settings) {
    Json json = Json::array();
    for (const lab::Setting& setting : settings)
        json.push_back({setting.name, setting.value});
    return json;
}

std::vector<lab::Setting> told_settings(const Json& json) {
    std::vector<lab::Setting> settings;
    for (const Json& setting : json)
        settings.push_back({setting[0].get<std::string>(), setting[1].get<std::string>()});
    return settings;
}

glm::ivec2 told_pixel(const Json& json) {
    return {json[0].get<int>(), json[1].get<int>()};
}

} // namespace

Json told(const lab::Situation& situation) {
    Json json = {{"size", {situation.extent.width, situation.extent.height}},
                 {"time", situation.time},
                 {"down", situation.down},
                 {"settings", told(situation.settings)},
                 {"definitions", told(situation.definitions)},
                 {"channels", situation.channels},
                 {"pass", situation.pass}};
    if (situation.stepped)
        json["stepped"] = *situation.stepped;
    if (situation.mouse)
        json["mouse"] = {situation.mouse->x, situation.mouse->y};
    if (situation.dragged_from)
        json["dragged_from"] = {situation.dragged_from->x, situation.dragged_from->y};
    if (const auto& camera = situation.camera)
        json["camera"] = {camera->azimuth, camera->elevation, camera->distance};
    return json;
}

lab::Situation told_situation(const Json& json) {
    lab::Situation situation;
    situation.extent = {json.at("size")[0].get<int>(), json.at("size")[1].get<int>()};
    json.at("time").get_to(situation.time);
    json.at("down").get_to(situation.down);
    json.at("channels").get_to(situation.channels);
    json.at("pass").get_to(situation.pass);
    if (json.contains("stepped"))
        situation.stepped = json["stepped"].get<int>();
    if (json.contains("mouse"))
        situation.mouse = told_pixel(json["mouse"]);
    if (json.contains("dragged_from"))
        situation.dragged_from = told_pixel(json["dragged_from"]);
    if (json.contains("camera"))
        situation.camera =
            render::OrbitCamera{json["camera"][0].get<double>(), json["camera"][1].get<double>(),
                                json["camera"][2].get<double>()};
    situation.settings = told_settings(json.at("settings"));
    situation.definitions = told_settings(json.at("definitions"));
    return situation;
}

Json told(const Asked& asked) {
    Json json = {{"probe", asked.probe->name},        {"verdict", int(asked.answer.verdict)},
                 {"sentence", asked.answer.sentence}, {"non_finite", asked.answer.non_finite},
                 {"seconds", asked.seconds},          {"picture", asked.picture.string()}};
    if (asked.answer.where)
        json["where"] = told(*asked.answer.where);
    return json;
}

Asked told_answer(const Json& line) {
    const auto name = line.at("probe").get<std::string>();
    Asked asked{&*std::ranges::find(lab::all_probes(), name, &lab::Probe::name), {}};
    asked.answer.verdict = lab::Verdict(line.at("verdict").get<int>());
    line.at("sentence").get_to(asked.answer.sentence);
    line.at("non_finite").get_to(asked.answer.non_finite);
    line.at("seconds").get_to(asked.seconds);
    asked.picture = line.at("picture").get<std::string>();
    if (line.contains("where"))
        asked.answer.where = told_situation(line["where"]);
    return asked;
}

} // namespace tidemark::cli
