#include "cli/view/live_inputs.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "live/inputs/osc_command.hpp"
#include "live/inputs/osc_socket.hpp"
#include "platform/window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace tidemark::cli {
namespace {

/// What follows in the same call sees it so.
void note(const live::Command& command, std::vector<scene::Knob>& knobs) {
    const auto* turned = std::get_if<live::TurnKnob>(&command);
    if (!turned)
        return;
    const auto knob = std::ranges::find(knobs, turned->name, &scene::Knob::name);
    if (knob != knobs.end())
        knob->value = turned->value;
}

} // namespace

LiveInputs::LiveInputs(void (*wake)()) : osc_(wake) {}

Result<std::unique_ptr<LiveInputs>> LiveInputs::open(const LiveInputRequest& request) {
    std::unique_ptr<LiveInputs> inputs(new LiveInputs(platform::Window::wake));
    if (request.osc)
        TRY(inputs->open_osc(*request.osc));
    return inputs;
}

Result<void> LiveInputs::open_osc(const std::string& where) {
    const auto socket = TRY(live::parse_osc_address(where).and_then(live::open_osc_socket));
    osc_receiver_ = std::make_unique<live::Receiver>(socket.descriptor, osc_);
    say(fmt::format("OSC: listening at {}", socket.address));
    return {};
}

live::Commands LiveInputs::take(std::vector<scene::Knob> knobs) {
    live::Commands commands;
    take_osc(commands, knobs);
    return commands;
}

void LiveInputs::take_osc(live::Commands& commands, std::vector<scene::Knob>& knobs) {
    for (const std::string& packet : osc_.take()) {
        const auto messages = live::parse_osc(packet);
        if (!messages) {
            words_.say("OSC: ignored: " + messages.error().message);
            continue;
        }
        for (const live::OscMessage& message : *messages) {
            auto command = osc_command(message, knobs);
            if (!command) {
                words_.say(command.error().message);
                continue;
            }
            note(*command, knobs);
            commands.push_back(*std::move(command));
        }
    }
}

} // namespace tidemark::cli
