#include "lab/check/situation.hpp"

#include "base/shell_word.hpp"
#include "render/mouse.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

glm::vec4 mouse_of(const Situation& situation) {
    if (situation.dragged_from)
        return render::Mouse::dragged(*situation.dragged_from, *situation.mouse, situation.down);
    return render::Mouse::clicked(situation.mouse->x, situation.mouse->y, situation.down);
}

} // namespace

render::FrameInputs inputs_of(const Situation& situation, int before) {
    render::FrameInputs inputs;
    if (situation.stepped) {
        inputs = render::inputs_of_frame(*situation.stepped - before, inputs.frame_rate);
    } else {
        inputs.time = situation.time - before * inputs.time_delta;
        inputs.frame = render::frame_at(situation.time, inputs.frame_rate) - before;
        inputs.date = render::later(inputs.date, inputs.time);
    }
    if (situation.mouse)
        inputs.mouse = mouse_of(situation);
    inputs.mouse_button.x = situation.mouse && situation.down ? 1 : 0;
    inputs.camera = situation.camera.value_or(render::OrbitCamera{}).matrix();
    return inputs;
}

int run_up_of(const Situation& situation) {
    constexpr int k_run_up = 8;
    return situation.stepped.value_or(std::min(inputs_of(situation).frame, k_run_up));
}

Result<scene::Scene> in_situation(scene::Scene scene, const Situation& situation) {
    for (const std::string& channel : situation.channels)
        if (auto set = scene::override_channel(scene, channel); !set)
            return fail(std::move(set.error()));
    auto turned = with(std::move(scene), situation.settings);
    return turned ? with(*std::move(turned), situation.definitions) : turned;
}

std::string capture_options(const Situation& situation) {
    std::string text = fmt::format("--size {}x{} ", situation.extent.width, situation.extent.height);
    text += situation.stepped ? fmt::format("--frame {}", *situation.stepped)
                              : fmt::format("--time {}", situation.time);
    if (situation.mouse) {
        text += fmt::format(" --mouse {},{}", situation.mouse->x, situation.mouse->y);
        if (const auto& from = situation.dragged_from)
            text += fmt::format(",{},{}", from->x, from->y);
        if (situation.down)
            text += ",down";
    }
    if (situation.camera)
        text += fmt::format(" --camera {},{},{}", situation.camera->azimuth, situation.camera->elevation,
                            situation.camera->distance);
    for (const Setting& setting : situation.settings)
        text += " --set " + shell_word(setting.name + "=" + setting.value);
    for (const Setting& setting : situation.definitions)
        text += " --define " + shell_word(setting.name + "=" + setting.value);
    for (const std::string& channel : situation.channels)
        text += " --channel " + shell_word(channel);
    if (!situation.pass.empty())
        text += " --pass " + shell_word(situation.pass);
    return text;
}

} // namespace tidemark::lab
