#include "window/live_inputs.hpp"

#include "base/error.hpp"
#include "host/console.hpp"
#include "window/midi.hpp"
#include "window/osc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace tidemark::window {

using namespace host;

void SaidOnce::say(std::string_view line) {
    line = line.substr(0, k_longest);
    if (said_.size() >= k_most_lines || !said_.emplace(line).second)
        return;
    host::say(line);
    if (said_.size() == k_most_lines)
        host::say("live inputs: further problems are not reported");
}

namespace {

/// Adds a command and removes an earlier one that sets the same thing: only the last value between two frames
/// counts.
void add(overlay::Commands& commands, overlay::Command command) {
    std::erase_if(commands, [&](const overlay::Command& earlier) {
        const auto* turned = std::get_if<overlay::TurnKnob>(&command);
        return earlier.index() == command.index() &&
               (!turned || turned->name == std::get<overlay::TurnKnob>(earlier).name);
    });
    commands.push_back(std::move(command));
}

/// Updates the knobs, so that later messages of the same call start from the new value.
void note(const overlay::Command& command, std::vector<scene::Knob>& knobs) {
    const auto* turned = std::get_if<overlay::TurnKnob>(&command);
    if (!turned)
        return;
    const auto knob = std::ranges::find(knobs, turned->name, &scene::Knob::name);
    if (knob != knobs.end())
        knob->value = turned->value;
}

} // namespace

LiveInputs::LiveInputs(const std::function<void()>& wake) : osc_(wake), midi_(wake) {}

Result<std::unique_ptr<LiveInputs>> LiveInputs::open(const LiveInputRequest& request,
                                                     const std::function<void()>& wake) {
    std::unique_ptr<LiveInputs> inputs(new LiveInputs(wake));
    if (request.osc)
        TRY(inputs->open_osc(*request.osc));
    if (request.midi)
        TRY(inputs->open_midi(*request.midi));
    if (request.microphone)
        inputs->microphone_ = TRY(sound::Microphone::open(*request.microphone));
    if (request.webcam)
        inputs->webcam_ = TRY(image::Camera::open(*request.webcam));
    return inputs;
}

Result<void> LiveInputs::open_osc(const std::string& where) {
    const auto socket = TRY(parse_osc_address(where).and_then(open_osc_socket));
    osc_receiver_ = std::make_unique<Receiver>(socket.descriptor, osc_);
    say(fmt::format("OSC: listening at {}", socket.address));
    return {};
}

/// Opens a port, or a file if the name contains a slash.
Result<void> LiveInputs::open_midi(const std::string& what) {
    if (what.find('/') == what.npos)
        midi_port_ = TRY(MidiPort::open(what, midi_));
    else
        midi_receiver_ = std::make_unique<Receiver>(TRY(open_midi_device(what)), midi_);
    return {};
}

void LiveInputs::hear() {
    render::LiveMedia media;
    if (microphone_)
        media.microphone = microphone_->hear();
    if (webcam_)
        media.webcam = webcam_->newest();
    media_ = std::make_shared<render::LiveMedia>(std::move(media));
}

void say_what_is_not_recorded(const LiveInputRequest& request) {
    if (request.microphone)
        say("the microphone is not recorded: a replay has the signal of a silent input");
    if (request.webcam)
        say("the webcam is not recorded: a replay has a placeholder picture");
}

overlay::Commands LiveInputs::take(std::vector<scene::Knob> knobs, ControllerMap& controllers) {
    overlay::Commands commands;
    take_osc(commands, knobs);
    take_midi(commands, knobs, controllers);
    return commands;
}

void LiveInputs::take_osc(overlay::Commands& commands, std::vector<scene::Knob>& knobs) {
    for (const std::string& packet : osc_.take()) {
        const auto messages = parse_osc(packet);
        if (!messages) {
            words_.say("OSC: ignored: " + messages.error().message);
            continue;
        }
        for (const OscMessage& message : *messages) {
            auto command = osc_command(message, knobs);
            if (!command) {
                words_.say(command.error().message);
                continue;
            }
            note(*command, knobs);
            add(commands, *std::move(command));
        }
    }
}

void LiveInputs::take_midi(overlay::Commands& commands, std::vector<scene::Knob>& knobs,
                           ControllerMap& controllers) {
    for (const std::string& bytes : midi_.take())
        for (const ControlChange& change : midi_parser_.parse(bytes)) {
            const bool learned = controllers.learning().has_value();
            auto turned = controllers.turn(change, knobs);
            if (!turned) {
                words_.say(fmt::format("MIDI: {} controls nothing: right-click a knob's name in the controls "
                                       "(Tab), then move the controller",
                                       to_string(change.controller)));
                continue;
            }
            if (learned)
                say(fmt::format("MIDI: {} controls {}", to_string(change.controller), turned->name));
            note(*turned, knobs);
            add(commands, *std::move(turned));
        }
}

} // namespace tidemark::window
