#include "lab/situation.hpp"

#include "render/mouse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

constexpr double k_frames_per_second = 60;
constexpr double k_last_frame = 1e8;

glm::vec4 mouse_of(const glm::ivec2& pixel, bool down) {
    render::Mouse mouse;
    mouse.press(pixel.x, pixel.y);
    if (!down) {
        mouse.frame_drawn();
        mouse.release();
    }
    return mouse.uniform();
}

std::string quoted(const std::string& word) {
    return word.find_first_of(" ()'") == word.npos ? word : fmt::format("\"{}\"", word);
}

} // namespace

render::FrameInputs inputs_of(const Situation& situation) {
    render::FrameInputs inputs;
    inputs.time = situation.time;
    inputs.frame = int(std::clamp(std::floor(situation.time * k_frames_per_second), 0.0, k_last_frame));
    if (situation.mouse)
        inputs.mouse = mouse_of(*situation.mouse, situation.down);
    return inputs;
}

std::string capture_options(const Situation& situation) {
    std::string text = fmt::format("--size {}x{} --time {}", situation.extent.width, situation.extent.height,
                                   situation.time);
    if (situation.mouse)
        text += fmt::format(" --mouse {},{}{}", situation.mouse->x, situation.mouse->y,
                            situation.down ? ",down" : "");
    for (const Setting& setting : situation.settings)
        text += " --set " + quoted(setting.name + "=" + setting.value);
    for (const std::string& channel : situation.channels)
        text += " --channel " + quoted(channel);
    if (!situation.pass.empty())
        text += " --pass " + quoted(situation.pass);
    return text;
}

} // namespace tidemark::lab
