#include "cli/picture_facts.hpp"

#include "cli/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {

std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene,
                                                             const Moment& moment) {
    const render::FrameState& state = moment.sequence.state;
    const glm::vec4 mouse = state.mouse.uniform();
    std::vector<std::pair<std::string, std::string>> metadata{
        {"Scene", scene.file.string()},
        {"Frame", fmt::format("{}", state.frame)},
        {"iTime", fmt::format("{}", state.seconds())},
        {"iMouse", fmt::format("{},{},{},{}", mouse.x, mouse.y, mouse.z, mouse.w)},
        {"Camera", to_string(state.camera)},
        {"Software", fmt::format("tidemark {}", k_version)}};
    std::string knobs;
    for (const scene::Knob& knob : scene.knobs)
        knobs += fmt::format("{}{}={}", knobs.empty() ? "" : "; ", knob.name,
                             scene::to_string(knob, value_after(knob, state.knobs)));
    if (!knobs.empty())
        metadata.emplace_back("Knobs", std::move(knobs));
    metadata.emplace_back(k_moment, dump(to_json(moment)));
    return metadata;
}

} // namespace tidemark::cli
