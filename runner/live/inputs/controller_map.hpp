// Which controller of a MIDI device turns which knob: learned by moving it, kept by whoever owns the map.
#pragma once

#include "live/command.hpp"
#include "live/inputs/midi_parser.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::live {

/// One number of a knob.
struct KnobPart {
    std::string knob;
    size_t component = 0;
    bool operator==(const KnobPart&) const = default;
};

struct Binding {
    Controller controller;
    KnobPart part;
    bool operator==(const Binding&) const = default;
};

/// `controller 7`, `controller 7 of channel 2`.
std::string to_string(const Controller& controller);
/// `height`, `tint.g`.
std::string to_string(const KnobPart& part, const scene::Knob& knob);

/// The value of a component where its controller stands: from one end of the knob's range to the other, in
/// its steps. Without a range that is 0 to 1, of whole numbers 0 to 127.
double value_at(const scene::Knob& knob, size_t component, int midi_value);

class ControllerMap {
public:
    ControllerMap() = default;
    explicit ControllerMap(std::vector<Binding> bindings) : bindings_(std::move(bindings)) {}

    /// The next controller that moves turns that part, and nothing else. Again: none does.
    void learn(const KnobPart& part);
    void forget(const KnobPart& part);
    /// Of what is being learned.
    const std::optional<KnobPart>& learning() const { return learning_; }
    /// Which controller turns a part.
    std::optional<Controller> controller_of(const KnobPart& part) const;
    const std::vector<Binding>& bindings() const { return bindings_; }

    /// Ends the learning. Nothing where the scene has no such part.
    std::optional<TurnKnob> turn(const ControlChange& change, std::span<const scene::Knob> knobs);

private:
    std::vector<Binding> bindings_; ///< each controller and each part once
    std::optional<KnobPart> learning_;
};

} // namespace tidemark::live
