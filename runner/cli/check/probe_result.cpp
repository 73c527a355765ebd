#include "cli/check/probe_result.hpp"

#include "cli/state_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace tidemark::cli {

Json to_json(const ProbeResult& asked) {
    Json json = {{"probe", asked.probe->name},        {"verdict", int(asked.answer.verdict)},
                 {"sentence", asked.answer.sentence}, {"non_finite", asked.answer.non_finite},
                 {"seconds", asked.seconds},          {"picture", asked.picture.string()}};
    if (asked.answer.where)
        json["where"] = to_json(*asked.answer.where);
    return json;
}

ProbeResult result_of(const Json& line) {
    const auto name = line.at("probe").get<std::string>();
    ProbeResult asked{&*std::ranges::find(lab::all_probes(), name, &lab::Probe::name), {}};
    asked.answer.verdict = lab::Verdict(line.at("verdict").get<int>());
    line.at("sentence").get_to(asked.answer.sentence);
    line.at("non_finite").get_to(asked.answer.non_finite);
    line.at("seconds").get_to(asked.seconds);
    asked.picture = line.at("picture").get<std::string>();
    if (line.contains("where"))
        asked.answer.where = frame_state_of(line["where"]);
    return asked;
}

} // namespace tidemark::cli
