#include "cli/omissions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

constexpr const char* k_host_uniforms[] = {
    "iResolution", "iTime",        "iTimeDelta",         "iFrame", "iFrameRate", "iMouse", "iDate",
    "iSampleRate", "iChannelTime", "iChannelResolution", "iCamera"};

void add_list(std::vector<std::string>& left_out, std::string_view what,
              const std::vector<std::string>& names) {
    if (!names.empty())
        left_out.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
}

} // namespace

SceneFacts facts_of(const render::Renderer& renderer) {
    SceneFacts facts;
    const render::PlannedPass& planned = renderer.plan().passes.back();
    const gl::Reflection& reflection = renderer.program(planned.pass).reflection();
    const scene::Pass& pass = renderer.scene().passes[planned.pass];
    facts.channels = planned.channels;
    for (const gl::Uniform& uniform : reflection.uniforms)
        facts.uniforms.push_back(uniform.name);

    std::vector<std::string> uniforms;
    for (const char* name : k_host_uniforms)
        if (!reflection.has(name))
            uniforms.emplace_back(name);
    std::vector<std::string> knobs;
    for (const scene::Knob& knob : renderer.scene().knobs)
        if (!reflection.has(knob.name))
            knobs.push_back(knob.name);
    std::vector<std::string> channels;
    bool noise = false;
    for (int i = 0; i < scene::k_channel_count; ++i) {
        const bool read =
            std::find(planned.channels.begin(), planned.channels.end(), i) != planned.channels.end();
        if (!read)
            channels.push_back(fmt::format("iChannel{}", i));
        noise = noise || (read && std::holds_alternative<scene::Noise>(pass.channels[size_t(i)].input));
    }
    add_list(facts.left_out, "uniforms", uniforms);
    add_list(facts.left_out, "knobs", knobs);
    add_list(facts.left_out, "channels", channels);
    if (!noise)
        facts.left_out.emplace_back("noise texture");
    return facts;
}

} // namespace tidemark::cli
