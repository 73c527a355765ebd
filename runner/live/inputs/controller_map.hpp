// Bindings of MIDI controllers to knobs, learned by moving a controller. The owner of the map keeps them.
#pragma once

#include "live/command.hpp"
#include "live/inputs/midi_parser.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::live {

/// One component of a knob.
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

/// Formats a controller: `controller 7`, `controller 7 of channel 2`.
std::string to_string(const Controller& controller);
/// Formats a component: `height`, `tint.g`.
std::string to_string(const KnobPart& part, const scene::Knob& knob);

/// Returns the value of a component for a controller's position: linear over the knob's range, rounded to its
/// steps. Without a range it is 0 to 1, or 0 to 127 for whole numbers.
double value_at(const scene::Knob& knob, size_t component, int midi_value);

class ControllerMap {
public:
    ControllerMap() = default;
    explicit ControllerMap(std::vector<Binding> bindings) : bindings_(std::move(bindings)) {}

    /// Binds the next controller that moves to that part, replacing the earlier bindings of both. A second
    /// call for the same part cancels.
    void learn(const KnobPart& part);
    void forget(const KnobPart& part);
    /// Returns the part that waits for a controller.
    const std::optional<KnobPart>& learning() const { return learning_; }
    /// Returns the controller that is bound to a part.
    std::optional<Controller> controller_of(const KnobPart& part) const;
    const std::vector<Binding>& bindings() const { return bindings_; }

    /// Completes `learn` if it is pending, then returns the change of the bound knob. Returns nothing where
    /// the controller is not bound or the scene has no such part.
    std::optional<TurnKnob> turn(const ControlChange& change, std::span<const scene::Knob> knobs);

private:
    std::vector<Binding> bindings_; ///< each controller and each part at most once
    std::optional<KnobPart> learning_;
};

} // namespace tidemark::live
