#include "cli/picture_facts.hpp"

#include "cli/version.hpp"

#include <fmt/format.h>

namespace tidemark::cli {

std::string camera_fact(const render::OrbitCamera& camera) {
    const glm::dvec3& target = camera.target;
    return to_string(camera) +
           (target == glm::dvec3(0) ? "" : fmt::format(" around {},{},{}", target.x, target.y, target.z));
}

std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene,
                                                             const render::FrameState& state) {
    const glm::vec4 mouse = state.mouse.uniform();
    std::vector<std::pair<std::string, std::string>> metadata{
        {"Scene", scene.file.string()},
        {"Frame", fmt::format("{}", state.frame)},
        {"iTime", fmt::format("{}", state.seconds())},
        {"iMouse", fmt::format("{},{},{},{}", mouse.x, mouse.y, mouse.z, mouse.w)},
        {"Camera", camera_fact(state.camera)},
        {"Software", fmt::format("tidemark {}", k_version)}};
    std::string knobs;
    for (const scene::Knob& knob : scene.knobs)
        knobs += fmt::format("{}{}={}", knobs.empty() ? "" : "; ", knob.name,
                             scene::to_string(knob, value_after(knob, state.knobs)));
    if (!knobs.empty())
        metadata.emplace_back("Knobs", std::move(knobs));
    return metadata;
}

} // namespace tidemark::cli
